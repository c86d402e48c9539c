/* Directivity of a reflector: its visibility function, and lobes.
 *
 * The visibility V of a point (MODEL 2.2) is a factor that depends on delta in [0, pi], the angle
 * between the point's facing and the direction to the sensor. All shapes are 1 up to full_rad,
 * except cosine, which falls from the start, and 0 beyond zero_rad. */
#pragma once

#include "base/vec2.h"

enum visibility_shape {
    VISIBILITY_RAISED_COSINE, /* half a cosine between full_rad and zero_rad; 0 at zero_rad */
    VISIBILITY_HARD,   /* 1 up to and at zero_rad; with zero_rad = pi it is omnidirectional */
    VISIBILITY_LINEAR, /* a straight line between full_rad and zero_rad; 0 at zero_rad */
    VISIBILITY_COSINE, /* cos(pi delta / (2 zero_rad)); 0 at zero_rad */
};

/* The angle between two directions, in [0, pi]; neither needs unit length, and the order does not
 * matter. Accurate near 0 and pi, where acos of a dot product is not. */
double directivity_angle_rad(struct vec2 a, struct vec2 b);

/* V in [0, 1]. Needs 0 <= full_rad <= zero_rad. Where both are equal, the raised cosine and the
 * straight line are hard too: V is 1 at that angle, because full visibility includes its end. */
double directivity_visibility(enum visibility_shape shape, double full_rad, double zero_rad,
                              double delta_rad);

/* V of a point that faces along a unit vector, seen along to_viewer, the vector from the point to
 * the sensor (or to the bounce of a ghost). The same double as directivity_visibility at the angle
 * between both, which is computed only where V is not clearly 0. */
double directivity_visibility_along(enum visibility_shape shape, double full_rad, double zero_rad,
                                    struct vec2 facing, struct vec2 to_viewer);

/* A little less than cos(zero_rad): V is surely 0 where the cosine of delta is below this value. */
double directivity_dark_cosine(double zero_rad);

/* True only if V is 0 for every viewer within slack_m of the end of to_viewer. dark_cosine comes
 * from directivity_dark_cosine. */
static inline bool directivity_surely_zero(double dark_cosine, struct vec2 facing,
                                           struct vec2 to_viewer, double slack_m)
{
    /* Both sides together change by at most 1 + |dark_cosine| < 3 per metre of the viewer's
     * place. */
    return vec2_dot(facing, to_viewer) < dark_cosine * vec2_length(to_viewer) - 3 * slack_m;
}

/* Lobe of a scattering point by 3GPP TR 38.901, 7.9.2. In decibels it is a parabola in azimuth plus
 * another in zenith angle, each and both together at most depth_db deep:
 *
 *     drop = min(12 (off/width)^2, depth) + min(12 ((zenith - middle)/width)^2, depth)
 *
 * Half a width off the middle the lobe is 3 dB down. */
struct lobe {
    double width_rad;        /* in azimuth, between the two angles 3 dB down; 0: no drop in
                              * azimuth */
    double zenith_rad;       /* of the lobe's middle; 0 is straight up, pi/2 level */
    double zenith_width_rad; /* as width_rad, in zenith angle; 0: no drop in height */
    double depth_db;         /* 0: no lobe, the factor is 1 everywhere */
};

/* The factor on amplitude, in (0, 1], for a viewer off_rad in [0, pi] of azimuth from the lobe's
 * middle, at the zenith angle zenith_rad as seen from the point. */
double directivity_lobe_factor(const struct lobe *lobe, double off_rad, double zenith_rad);
