/* Exact side of a line and order along a direction.
 *
 * Every yes-or-no decision of glint's geometry (is the line of sight blocked, does it touch a
 * corner) depends on these signs, so no compiler and no CPU changes an answer. A floating-point
 * filter decides nearly all calls; the others are summed exactly (J. R. Shewchuk, Adaptive
 * Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, 1997). Exact as long as
 * no product of coordinates under- or overflows: each coordinate is 0 or has a size between 1e-140
 * and 1e140 m. */
#pragma once

#include "base/vec2.h"

/* The difference of two products is off by at most (3 + 16u)u of the sum of their sizes, u = 2^-53
 * (Shewchuk's filter for orientation). 4u leaves room for a bound that is itself rounded among the
 * subnormals. */
#define PREDICATES_ROUNDING 0x1p-51

/* The orientation by exact summation, where the filter cannot decide. */
int predicates_exact_sign(struct vec2 a, struct vec2 b, struct vec2 c);

/* The sign of (b - a) × (c - a): +1 if c lies to the left of the line from a to b, -1 to the right,
 * 0 exactly on it (or a == b). */
static inline int predicates_orientation(struct vec2 a, struct vec2 b, struct vec2 c)
{
    double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
    double error = PREDICATES_ROUNDING * (fabs(left) + fabs(right)), determinant = left - right;
    if (determinant > error)
        return 1;
    if (determinant < -error)
        return -1;
    return predicates_exact_sign(a, b, c);
}

/* The sign of (b - a) · direction: +1 if b is farther along the direction than a, -1 if a is, 0 if
 * they are exactly abreast. */
int predicates_along(struct vec2 a, struct vec2 b, struct vec2 direction);
