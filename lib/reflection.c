#include "reflection.h"

#include "orientation.h"

bool reflection_foot(struct vec2 a, struct vec2 b, double margin_m, struct vec2 sensor,
                     struct vec2 *foot)
{
    if (orientation_sign(a, b, sensor) >= 0)
        return false;
    struct vec2 edge = vec2_sub(b, a);
    double length_m = vec2_length(edge);
    /* Accurate, so that a joint of two exactly collinear sides never loses its foot (NUMERICS 33).
     */
    double from_a = vec2_dot_accurate(vec2_sub(sensor, a), edge);
    double from_b = vec2_dot_accurate(vec2_sub(b, sensor), edge);
    if (from_a < margin_m * length_m || from_b < margin_m * length_m)
        return false;
    /* Measured from the middle, so that a mirrored side has the mirrored foot to the last bit. */
    struct vec2 middle = vec2_scale(0.5, vec2_add(a, b));
    double offset = (from_a - from_b) / (2 * vec2_dot(edge, edge));
    *foot = vec2_add(middle, vec2_scale(offset, edge));
    return true;
}
