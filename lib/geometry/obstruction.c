#include "geometry/obstruction.h"

#include "base/elementary.h"
#include "geometry/predicates.h"

/* nu from which on nothing passes, 2 sqrt(2), and up to which nothing is lost. */
#define DARKEST_PARAMETER 2.82842712474619009760
#define LIT (-0.78)

#define TEN_TO_MINUS_069 0.204173794466952965

static bool intervals_touch(double p, double q, double a, double b)
{
    return (p <= a || p <= b || q <= a || q <= b) && (a <= p || a <= q || b <= p || b <= q);
}

/* True if the bounding boxes of two segments touch. Decides collinear segments and points, for
 * which all orientations are zero. */
static bool boxes_touch(struct vec2 p, struct vec2 q, struct vec2 a, struct vec2 b)
{
    return intervals_touch(p.x, q.x, a.x, b.x) && intervals_touch(p.y, q.y, a.y, b.y);
}

/* True if a and b lie on different sides of the line p-q, or one of them on it. */
static bool line_parts(struct vec2 p, struct vec2 q, struct vec2 a, struct vec2 b)
{
    return predicates_orientation(p, q, a) * predicates_orientation(p, q, b) <= 0;
}

bool obstruction_segments_touch(struct vec2 p, struct vec2 q, struct vec2 a, struct vec2 b)
{
    return boxes_touch(p, q, a, b) && line_parts(p, q, a, b) && line_parts(a, b, p, q);
}

bool obstruction_blocks(const struct vec2 *corners, size_t count, struct vec2 from, struct vec2 to)
{
    /* Tests edge by edge like obstruction_segments_touch, with one orientation per corner. */
    int first = predicates_orientation(from, to, corners[0]), side = first;
    for (size_t i = 0; i < count; i++) {
        bool last = i + 1 == count;
        struct vec2 corner = corners[i], next = corners[last ? 0 : i + 1];
        int next_side = last ? first : predicates_orientation(from, to, next);
        if (side * next_side <= 0 && boxes_touch(from, to, corner, next) &&
            line_parts(corner, next, from, to))
            return true;
        side = next_side;
    }
    return false;
}

/* d1 d2/(d1 + d2), without underflow. */
static double reduced_distance_m(double sensor_side_m, double reflector_side_m)
{
    double near = elementary_max(elementary_min(sensor_side_m, reflector_side_m), 0.1);
    double far = elementary_max(elementary_max(sensor_side_m, reflector_side_m), 0.1);
    return near / (near / far + 1);
}

double obstruction_edge_parameter(double depth_m, double sensor_side_m, double reflector_side_m,
                                  double wavelength_m)
{
    return depth_m * sqrt(2 / wavelength_m / reduced_distance_m(sensor_side_m, reflector_side_m));
}

double obstruction_edge_amplitude_factor(double parameter)
{
    if (!(parameter > LIT))
        return 1;
    double steepness = elementary_hypot(parameter - 0.1, 1) + (parameter - 0.1);
    return TEN_TO_MINUS_069 / steepness / steepness;
}

/* d1 d2/(d1 + d2) is largest half way, and each distance may have grown by 0.1 m. */
double obstruction_edge_reach_m(double range_m, double wavelength_m)
{
    return sqrt(wavelength_m * (range_m + 0.2) / 4);
}

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

/* The line's least height above the top over its interval inside the outline, or its least distance
 * below the bottom. */
static double clear_m(const struct obstruction_line *line, struct inside_interval inside,
                      struct obstruction_heights body)
{
    double begin_m = height_m(line, inside.begin), end_m = height_m(line, inside.end);
    double above_m = elementary_min(begin_m, end_m) - body.top_m;
    if (body.bottom_m == 0)
        return above_m;
    return elementary_max(above_m, body.bottom_m - elementary_max(fabs(begin_m), fabs(end_m)));
}

double obstruction_clear_m(const struct vec2 *corners, size_t count,
                           struct obstruction_heights body, const struct obstruction_line *line)
{
    return clear_m(line, inside_interval_of(corners, count, line), body);
}

/* nu of an edge across the line at both ends of its interval inside the outline, the greater one.
 * Depths are those of the line in the shadow. */
static double across(const struct obstruction_line *line, struct inside_interval inside,
                     double begin_depth_m, double end_depth_m, double wavelength_m)
{
    double length_m = vec2_length(vec2_sub(line->to, line->from));
    double front = obstruction_edge_parameter(begin_depth_m, inside.begin * length_m,
                                              (1 - inside.begin) * length_m, wavelength_m);
    double back = obstruction_edge_parameter(end_depth_m, inside.end * length_m,
                                             (1 - inside.end) * length_m, wavelength_m);
    return elementary_max(front, back);
}

/* nu of the easier way over the top or under the bottom. */
static double over_or_under(const struct obstruction_line *line, struct inside_interval inside,
                            struct obstruction_heights body, double wavelength_m)
{
    double begin_m = height_m(line, inside.begin), end_m = height_m(line, inside.end);
    double over = across(line, inside, body.top_m - begin_m, body.top_m - end_m, wavelength_m);
    if (body.bottom_m == 0)
        return over;
    return elementary_min(over, across(line, inside, fabs(begin_m) - body.bottom_m,
                                       fabs(end_m) - body.bottom_m, wavelength_m));
}

/* nu of the ways past a body to the left and to the right. */
struct ways {
    double left, right;
};

static struct ways harder(struct ways so_far, double left, double right)
{
    return (struct ways){elementary_max(so_far.left, left), elementary_max(so_far.right, right)};
}

static double easier(struct ways ways)
{
    return elementary_min(ways.left, ways.right);
}

/* nu of the easiest way past the body, and of the easiest one beside it. A line that does not touch
 * the body may pass each corner beside, over or under it. */
struct passage {
    double easiest, beside;
};

static struct passage passage_beside(const struct vec2 *corners, size_t count,
                                     const struct obstruction_line *line,
                                     struct obstruction_heights body, bool touched,
                                     double wavelength_m)
{
    struct vec2 way = vec2_sub(line->to, line->from);
    double length_m = vec2_length(way), nothing = -(double)INFINITY;
    struct ways aside = {nothing, nothing}, any = aside;
    struct vec2 along = vec2_scale(1 / length_m, way);
    for (size_t i = 0; i < count; i++) {
        struct vec2 offset = vec2_sub(corners[i], line->from);
        double foot_m = vec2_dot(along, offset);
        if (!touched && !(foot_m > 0 && foot_m < length_m))
            continue;
        double before_m = elementary_min(elementary_max(foot_m, 0), length_m);
        double parameter = obstruction_edge_parameter(vec2_cross(along, offset), before_m,
                                                      length_m - before_m, wavelength_m);
        aside = harder(aside, parameter, -parameter);
        if (touched)
            continue;
        struct inside_interval corner = {before_m / length_m, before_m / length_m};
        double over = over_or_under(line, corner, body, wavelength_m);
        any = harder(any, elementary_min(parameter, over), elementary_min(-parameter, over));
    }
    return (struct passage){easier(touched ? aside : any), easier(aside)};
}

static double factor_at(double parameter)
{
    return parameter < DARKEST_PARAMETER ? obstruction_edge_amplitude_factor(parameter) : 0;
}

struct obstruction obstruction_of(const struct vec2 *corners, size_t count,
                                  struct obstruction_heights body,
                                  const struct obstruction_line *line, double wavelength_m)
{
    bool touched = obstruction_blocks(corners, count, line->from, line->to);
    if (wavelength_m == 0 && (!touched || (isinf(body.top_m) && body.bottom_m == 0)))
        return (struct obstruction){.factor = touched ? 0 : 1};
    struct inside_interval inside = inside_interval_of(corners, count, line);
    double straight = touched && clear_m(line, inside, body) <= 0 ? 0 : 1;
    if (wavelength_m == 0 || vec2_same(line->from, line->to))
        return (struct obstruction){.factor = straight, .over = touched && straight == 1};
    if (!touched && inside.end - inside.begin == 1)
        return (struct obstruction){.factor = 1};
    struct passage past = passage_beside(corners, count, line, body, touched, wavelength_m);
    if (touched)
        past.easiest = elementary_min(past.beside, over_or_under(line, inside, body, wavelength_m));
    double factor = factor_at(past.easiest);
    return (struct obstruction){
        .factor = factor, .bent = factor != straight, .over = factor != factor_at(past.beside)};
}
