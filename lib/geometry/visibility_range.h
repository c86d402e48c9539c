/* How much of a point reflector is seen from an impinging angle (MODEL 2.2).
 *
 * The paper states that a point's cross section is a scaled visibility function of the impinging
 * angle and leaves its shape open; these are the shapes on offer. delta is the angle between the
 * point's facing and the direction to the sensor, in [0, pi]. All shapes are 1 up to full_rad,
 * except cosine, which falls from the start, and 0 beyond zero_rad. */
#ifndef VISIBILITY_RANGE_H
#define VISIBILITY_RANGE_H

#include <stdbool.h>

#include "base/vec2.h"

enum visibility_shape {
    VISIBILITY_RAISED_COSINE, /* half a cosine between full_rad and zero_rad; 0 at zero_rad */
    VISIBILITY_HARD,   /* 1 up to and at zero_rad; with zero_rad = pi it is omnidirectional */
    VISIBILITY_LINEAR, /* a straight line between full_rad and zero_rad; 0 at zero_rad */
    VISIBILITY_COSINE, /* cos(pi delta / (2 zero_rad)); 0 at zero_rad */
};

/* The angle between two directions, in [0, pi]; neither needs unit length, and the order does not
 * matter. Accurate near 0 and pi, where acos of a dot product is not (NUMERICS 12). */
double visibility_range_angle_rad(struct vec2 a, struct vec2 b);

/* V in [0, 1]. Needs 0 <= full_rad <= zero_rad; where both are equal, the raised cosine and the
 * straight line are hard too: 1 at that angle, which full visibility reaches. */
double visibility_range_factor(enum visibility_shape shape, double full_rad, double zero_rad,
                               double delta_rad);

/* V of what faces along a unit vector, from the end of a sight: to the last bit that at the angle
 * between both, which is only worked out where the answer is not plainly 0 or 1. */
double visibility_range_along(enum visibility_shape shape, double full_rad, double zero_rad,
                              struct vec2 facing, struct vec2 sight);

/* V is 0 at angles with cosines below this: less than that of zero_rad by far more than rounding.
 */
double visibility_range_dark_cosine(double zero_rad);

/* True only if V is 0 along that sight, and along any whose end is within slack_m of its end. */
static inline bool visibility_range_plainly_none(double dark_cosine, struct vec2 facing,
                                                 struct vec2 sight, double slack_m)
{
    /* 1 + |the cosine| < 3: what a sight's end can change per metre. */
    return vec2_dot(facing, sight) < dark_cosine * vec2_length(sight) - 3 * slack_m;
}

#endif
