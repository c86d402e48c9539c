#include "ideal/sight_margins.h"

#include "base/elementary.h"
#include "base/units.h"
#include "geometry/obstruction.h"

double sight_margins_facing_m(const struct box *box, enum visibility_shape shape, double facing_rad,
                              double zero_rad, struct vec2 place, struct vec2 sensor)
{
    if (shape == VISIBILITY_HARD && zero_rad >= PI)
        return (double)INFINITY;
    struct vec2 facing = vec2_turn(vec2_heading(facing_rad), box->heading);
    struct vec2 sight = vec2_sub(sensor, place);
    return fabs(zero_rad - directivity_angle_rad(facing, sight)) * vec2_length(sight);
}

double sight_margins_foot_m(struct vec2 a, struct vec2 b, struct vec2 along, double margin_m,
                            struct vec2 sensor)
{
    if (vec2_same(a, b))
        return (double)NAN;
    double outside_m = -vec2_cross(along, vec2_sub(sensor, a));
    double from_a_m = vec2_dot(vec2_sub(sensor, a), along) - margin_m;
    double from_b_m = vec2_dot(vec2_sub(b, sensor), along) - margin_m;
    return fabs(elementary_min(outside_m, elementary_min(from_a_m, from_b_m)));
}

static double to_line_m(struct vec2 a, struct vec2 b, struct vec2 point)
{
    struct vec2 line = vec2_sub(b, a), offset = vec2_sub(point, a);
    double length_m = vec2_length(line);
    return length_m > 0 ? fabs(vec2_cross(line, offset)) / length_m : vec2_length(offset);
}

static double to_segment_m(struct vec2 a, struct vec2 b, struct vec2 point)
{
    struct vec2 line = vec2_sub(b, a);
    if (vec2_dot(line, vec2_sub(point, a)) <= 0)
        return vec2_length(vec2_sub(point, a));
    if (vec2_dot(line, vec2_sub(point, b)) >= 0)
        return vec2_length(vec2_sub(point, b));
    return to_line_m(a, b, point);
}

/* The least distance of an end of p to q from a to b, or of an end of a to b from p to q. */
static double least_m(double (*distance_m)(struct vec2 a, struct vec2 b, struct vec2 point),
                      struct vec2 p, struct vec2 q, struct vec2 a, struct vec2 b)
{
    return elementary_min(elementary_min(distance_m(p, q, a), distance_m(p, q, b)),
                          elementary_min(distance_m(a, b, p), distance_m(a, b, q)));
}

double sight_margins_outline_m(const struct vec2 *corners, size_t count, struct vec2 from,
                               struct vec2 to)
{
    double nearest_m = (double)INFINITY;
    for (size_t i = 0; i < count; i++)
        nearest_m = elementary_min(
            nearest_m, least_m(to_segment_m, from, to, corners[i], corners[(i + 1) % count]));
    return nearest_m;
}

double sight_margins_depth_m(const struct vec2 *corners, size_t count, struct vec2 from,
                             struct vec2 to)
{
    double deepest_m = 0;
    for (size_t i = 0; i < count; i++) {
        struct vec2 next = corners[(i + 1) % count];
        if (obstruction_segments_touch(from, to, corners[i], next))
            deepest_m = elementary_max(deepest_m, least_m(to_line_m, from, to, corners[i], next));
    }
    return deepest_m;
}
