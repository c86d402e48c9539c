/* Visibility factor V of a point reflector by viewing angle (MODEL 2.2).
 *
 * delta is the angle between the point's facing and the direction to the sensor, in [0, pi]. All
 * shapes are 1 up to full_rad, except cosine, which falls from the start, and 0 beyond zero_rad. */
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
double visibility_range_angle_rad(struct vec2 a, struct vec2 b);

/* V in [0, 1]. Needs 0 <= full_rad <= zero_rad. Where both are equal, the raised cosine and the
 * straight line are hard too: V is 1 at that angle, because full visibility includes its end. */
double visibility_range_factor(enum visibility_shape shape, double full_rad, double zero_rad,
                               double delta_rad);

/* V of a point that faces along a unit vector, seen along to_viewer, the vector from the point to
 * the sensor (or to the bounce of a ghost). The result is that of visibility_range_factor at the
 * angle between both, to the last bit; the angle is only computed where V is not plainly 0 or 1. */
double visibility_range_along(enum visibility_shape shape, double full_rad, double zero_rad,
                              struct vec2 facing, struct vec2 to_viewer);

/* V is 0 wherever the cosine of delta is below this value, which lies below cos(zero_rad) by far
 * more than rounding. */
double visibility_range_dark_cosine(double zero_rad);

/* True only if V is 0 for every viewer within slack_m of the end of to_viewer. dark_cosine is that
 * of visibility_range_dark_cosine. */
static inline bool visibility_range_surely_zero(double dark_cosine, struct vec2 facing,
                                                struct vec2 to_viewer, double slack_m)
{
    /* Both sides together change by at most 1 + |dark_cosine| < 3 per metre of the viewer's
     * place. */
    return vec2_dot(facing, to_viewer) < dark_cosine * vec2_length(to_viewer) - 3 * slack_m;
}
