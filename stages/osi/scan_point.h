/* A target as viewers draw it, with its label. */
#pragma once

#include "trace.h"

struct scan_point {
    struct vec2 place_m;   /* in the axes of the sensor (frame_target_place) */
    double up_m;           /* over the sensor; 0: it measures no elevation */
    uint32_t object;       /* number of the strongest contributor's object; 0: of none */
    uint32_t path;         /* enum path of the strongest contributor */
    uint32_t contributors; /* how many */
};

/* The azimuth of a target as a turn about the vertical axis of its sensor, after which its
 * elevation is a turn upward. A sensor that measures elevation reports another azimuth: the angle
 * of a cone (frame_target_place). */
double scan_point_azimuth_rad(const struct target *target);

/* The point of a target of the trace's frame. */
struct scan_point scan_point_of(struct trace *trace, const struct target *target);
