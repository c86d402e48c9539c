#include "visibility.h"

#include <math.h>

#include "elementary.h"
#include "units.h"

double visibility_angle_rad(struct vec2 a, struct vec2 b)
{
    /* + 0.0 turns -0 into 0: a vector of length zero is at angle 0, never at pi. */
    return elementary_atan2(fabs(vec2_cross(a, b)), vec2_dot(a, b) + 0.0);
}

double visibility(enum visibility_shape shape, double full_rad, double zero_rad, double delta_rad)
{
    if (shape == VISIBILITY_HARD)
        return delta_rad <= zero_rad;
    double start_rad = shape == VISIBILITY_COSINE ? 0 : full_rad;
    if (delta_rad <= start_rad)
        return 1;
    if (delta_rad >= zero_rad)
        return 0;
    /* Counted from the dark end, so that no shape can round to a negative value there. */
    double rise = (zero_rad - delta_rad) / (zero_rad - start_rad);
    if (shape == VISIBILITY_LINEAR)
        return rise;
    double cosine = elementary_sin(PI / 2 * rise);
    return shape == VISIBILITY_COSINE ? cosine : cosine * cosine;
}
