/* Sensing targets of 3GPP TR 38.901, 7.9.2: vehicle and human. A vehicle has five scattering
 * points, each in the middle of a face, with a lobe and a floor that is seen from everywhere; a
 * human has one (MODEL 2.8). The cross sections are means over the report's log-normal fluctuation
 * of 3.41 and 3.94 dB, which a sensor's `fluctuation` adds. */
#pragma once

#include "frame/reflectors.h"

enum sensing_target_3gpp {
    SENSING_TARGET_3GPP_NONE,
    SENSING_TARGET_3GPP_VEHICLE,
    SENSING_TARGET_3GPP_HUMAN
};
extern const char *const sensing_target_3gpp_names[]; /* ending with NULL */

/* Replaces the set's points, planes and rows by the target's points; mirrors and whether the object
 * blocks stay. Not for SENSING_TARGET_3GPP_NONE. */
void sensing_target_3gpp_describe(enum sensing_target_3gpp target, struct reflector_set *set,
                                  struct arena *arena);
