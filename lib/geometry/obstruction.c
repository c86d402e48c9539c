#include "geometry/obstruction.h"

#include "base/elementary.h"
#include "geometry/knife_edge.h"
#include "geometry/outline_crossing.h"

#define DARKEST_PARAMETER 2.82842712474619009760

/* The part of a line inside a convex outline, as fractions of its length. A line that only touches
 * the outline has the place where it touches, but for rounding. */
struct inside_interval {
    double begin, end;
};

static struct inside_interval inside_interval_of(const struct vec2 *corners, size_t count,
                                                 const struct obstruction_line *line)
{
    struct inside_interval inside = {0, 1};
    for (size_t i = 0; i < count; i++) {
        struct vec2 edge = vec2_sub(corners[i + 1 < count ? i + 1 : 0], corners[i]);
        double from = vec2_cross(edge, vec2_sub(line->from, corners[i]));
        double to = vec2_cross(edge, vec2_sub(line->to, corners[i]));
        if (from < 0 && to > from)
            inside.begin = elementary_max(inside.begin, elementary_min(from / (from - to), 1));
        if (to < 0 && from > to)
            inside.end = elementary_min(inside.end, elementary_max(from / (from - to), 0));
    }
    return inside;
}

static double height_m(const struct obstruction_line *line, double fraction)
{
    return line->from_height_m + fraction * (line->to_height_m - line->from_height_m);
}

/* The line's least height above the top over its interval inside the outline. */
static double above_m(const struct obstruction_line *line, struct inside_interval inside,
                      double top_m)
{
    return elementary_min(height_m(line, inside.begin), height_m(line, inside.end)) - top_m;
}

double obstruction_above_m(const struct vec2 *corners, size_t count, double top_m,
                           const struct obstruction_line *line)
{
    return above_m(line, inside_interval_of(corners, count, line), top_m);
}

/* nu of the easier way beside the body, to the left or to the right. */
static double beside(const struct vec2 *corners, size_t count, const struct obstruction_line *line,
                     bool touched, double wavelength_m)
{
    struct vec2 way = vec2_sub(line->to, line->from);
    double length_m = vec2_length(way), left = -(double)INFINITY, right = left;
    struct vec2 along = vec2_scale(1 / length_m, way);
    for (size_t i = 0; i < count; i++) {
        struct vec2 offset = vec2_sub(corners[i], line->from);
        double foot_m = vec2_dot(along, offset);
        if (!touched && !(foot_m > 0 && foot_m < length_m))
            continue;
        double before_m = elementary_min(elementary_max(foot_m, 0), length_m);
        double parameter = knife_edge_parameter(vec2_cross(along, offset), before_m,
                                                length_m - before_m, wavelength_m);
        left = elementary_max(left, parameter);
        right = elementary_max(right, -parameter);
    }
    return elementary_min(left, right);
}

/* nu of the way over the top. */
static double above(const struct obstruction_line *line, struct inside_interval inside,
                    double top_m, double wavelength_m)
{
    double length_m = vec2_length(vec2_sub(line->to, line->from));
    double front =
        knife_edge_parameter(top_m - height_m(line, inside.begin), inside.begin * length_m,
                             (1 - inside.begin) * length_m, wavelength_m);
    double back = knife_edge_parameter(top_m - height_m(line, inside.end), inside.end * length_m,
                                       (1 - inside.end) * length_m, wavelength_m);
    return elementary_max(front, back);
}

static double factor_at(double parameter)
{
    return parameter < DARKEST_PARAMETER ? knife_edge_amplitude_factor(parameter) : 0;
}

struct obstruction obstruction_of(const struct vec2 *corners, size_t count, double top_m,
                                  const struct obstruction_line *line, double wavelength_m)
{
    bool touched = outline_crossing_blocks(corners, count, line->from, line->to);
    if (wavelength_m == 0 && (!touched || isinf(top_m)))
        return (struct obstruction){.factor = touched ? 0 : 1};
    struct inside_interval inside = inside_interval_of(corners, count, line);
    double straight = touched && above_m(line, inside, top_m) <= 0 ? 0 : 1;
    if (wavelength_m == 0 || vec2_same(line->from, line->to))
        return (struct obstruction){.factor = straight, .over = touched && straight == 1};
    if (!touched && inside.end - inside.begin == 1)
        return (struct obstruction){.factor = 1};
    double round = beside(corners, count, line, touched, wavelength_m);
    double factor = factor_at(elementary_min(round, above(line, inside, top_m, wavelength_m)));
    return (struct obstruction){
        .factor = factor, .bent = factor != straight, .over = factor != factor_at(round)};
}
