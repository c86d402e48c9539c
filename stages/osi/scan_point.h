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

/* The azimuth of a target about the vertical axis of its sensor, of which azimuth and elevation are
 * turns one after the other. The reported azimuth of a sensor that measures elevation is another
 * angle, that of a cone. */
double scan_point_azimuth_rad(const struct target *target);

/* The point of a target of the trace's frame. */
struct scan_point scan_point_of(struct trace *trace, const struct target *target);
