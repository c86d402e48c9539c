#include "geometry/outline_crossing.h"

#include "geometry/predicates.h"

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

bool outline_crossing_segments_touch(struct vec2 p, struct vec2 q, struct vec2 a, struct vec2 b)
{
    return boxes_touch(p, q, a, b) && line_parts(p, q, a, b) && line_parts(a, b, p, q);
}

bool outline_crossing_blocks(const struct vec2 *corners, size_t count, struct vec2 from,
                             struct vec2 to)
{
    /* Tests edge by edge like outline_crossing_segments_touch, with one orientation per corner. */
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
