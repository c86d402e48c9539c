#include "geometry/specular_point.h"

#include "geometry/predicates.h"

bool specular_point_foot(struct vec2 a, struct vec2 b, struct vec2 along, double margin_m,
                         struct vec2 sensor, struct vec2 *foot)
{
    struct vec2 across = vec2_left(vec2_sub(b, a));
    double square = vec2_dot(across, across);
    if (square == 0 || predicates_orientation(a, b, sensor) >= 0)
        return false;
    struct vec2 margin = vec2_scale(margin_m, along);
    if (predicates_along(vec2_add(a, margin), sensor, along) < 0 ||
        predicates_along(vec2_sub(b, margin), sensor, along) > 0)
        return false;
    /* Measured to the side's middle, so that a mirrored side has the mirrored foot to the last bit,
     * and added to the sensor's place, so that rounding the distance moves the foot along the line
     * of sight, not off it. */
    struct vec2 middle = vec2_scale(0.5, vec2_add(a, b));
    double steps = vec2_dot_accurate(vec2_sub(middle, sensor), across) / square;
    *foot = vec2_add(sensor, vec2_scale(steps, across));
    return true;
}
