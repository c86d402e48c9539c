/* Other reflectors of a class: its contour, 3GPP's sensing targets.
 *
 * A vehicle document may describe its class by mean cross sections (MODEL 2.7) or name a sensing
 * target of 3GPP (MODEL 2.8); each replaces the points, planes and rows of its reflector set. */
#pragma once

#include "frame/reflectors.h"

/* The contour: mean cross sections over scans by aspect; left and right are alike. The cross
 * section of each of the four faces is spread evenly over the face's length, as a density of power
 * per metre, and gathered in posts, one in the middle of each piece of the face.
 *
 * Posts are seen from their face's outer side, by a raised cosine over the angle off its normal
 * (directivity.h). It gives the face its whole cross section on the normal, half of the oblique one
 * at 45 degrees, where the next face adds the other half, and nothing from 90 degrees on or before.
 * So the powers of all posts in sight, added without regard to phase, make the class's cross
 * section on each normal and on each diagonal, whatever the spacing; an object longer or wider than
 * its class has more in proportion. */
struct contour {
    unsigned given; /* bits of the members that the document has: all or none */
    double front_dbsm, rear_dbsm, side_dbsm, oblique_dbsm;
};

extern const struct record contour_record;

/* The largest excess of the oblique cross section over another, in dB: half of the oblique one,
 * which each of two faces contributes, is then the whole of that face's. */
#define REFLECTOR_MODELS_OBLIQUE_DB 3.0

/* Refuses a larger oblique cross section, and a document with some members but not all. */
int reflector_models_check_contour(const struct contour *contour, struct diag *diag);

/* The angles off a face's normal up to which its posts are fully visible, and from which on they
 * are invisible. */
struct contour_view {
    double full_rad, zero_rad;
};
struct contour_view reflector_models_contour_view(double face_dbsm, double oblique_dbsm);

/* Replaces the set's points, planes and rows by four rows of posts, no farther apart than spacing_m
 * on an object of this size; mirrors and whether the object blocks stay. The sizes are at least
 * 0.01 m and the spacing 0.02 m. */
void reflector_models_of_contour(const struct contour *contour, double length_m, double width_m,
                                 double spacing_m, struct reflector_set *set, struct arena *arena);

/* Sensing targets of 3GPP TR 38.901, 7.9.2 (MODEL 2.8). A vehicle has five scattering points, each
 * in the middle of a face, with a lobe and a floor that is seen from everywhere; a human has one.
 * The cross sections are means over the report's log-normal fluctuation of 3.41 and 3.94 dB, which
 * a sensor's `fluctuation` adds. */
enum sensing_target_3gpp {
    SENSING_TARGET_3GPP_NONE,
    SENSING_TARGET_3GPP_VEHICLE,
    SENSING_TARGET_3GPP_HUMAN
};
extern const char *const reflector_models_3gpp_names[]; /* ending with NULL */

/* Replaces the set's points, planes and rows by the target's points; mirrors and whether the object
 * blocks stay. Not for SENSING_TARGET_3GPP_NONE. */
void reflector_models_of_3gpp(enum sensing_target_3gpp target, struct reflector_set *set,
                              struct arena *arena);
