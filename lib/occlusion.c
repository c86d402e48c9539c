#include "occlusion.h"

#include "orientation.h"

static bool intervals_touch(double p, double q, double a, double b)
{
    return fmin(p, q) <= fmax(a, b) && fmin(a, b) <= fmax(p, q);
}

/* Do a and b lie on different sides of the line p-q, or either of them on it? */
static bool line_parts(struct vec2 p, struct vec2 q, struct vec2 a, struct vec2 b)
{
    return orientation_sign(p, q, a) * orientation_sign(p, q, b) <= 0;
}

bool occlusion_segments_touch(struct vec2 p, struct vec2 q, struct vec2 a, struct vec2 b)
{
    /* The boxes settle collinear segments and points, whose signs are all zero. */
    return intervals_touch(p.x, q.x, a.x, b.x) && intervals_touch(p.y, q.y, a.y, b.y) &&
           line_parts(p, q, a, b) && line_parts(a, b, p, q);
}

bool occlusion_outline_blocks(const struct vec2 *corners, size_t count, struct vec2 from,
                              struct vec2 to)
{
    for (size_t i = 0; i < count; i++) {
        size_t next = i + 1 < count ? i + 1 : 0;
        if (occlusion_segments_touch(from, to, corners[i], corners[next]))
            return true;
    }
    return false;
}
