#include "geometry/box.h"

void box_outline(const struct box *box, struct vec2 corner[4])
{
    /* The places that box_place gives, from the same four products. */
    struct vec2 centre = box->motion.position_m;
    struct vec2 ahead = vec2_scale(0.5 * box->length_m, box->heading);
    struct vec2 left = vec2_left(vec2_scale(0.5 * box->width_m, box->heading));
    struct vec2 front_left = vec2_add(ahead, left), front_right = vec2_sub(ahead, left);
    corner[0] = vec2_add(centre, front_left);
    corner[1] = vec2_sub(centre, front_right);
    corner[2] = vec2_sub(centre, front_left);
    corner[3] = vec2_add(centre, front_right);
}

struct vec2 box_along(const struct box *box, double from_x, double from_y, double to_x, double to_y)
{
    struct vec2 own = {(to_x - from_x) * box->length_m, (to_y - from_y) * box->width_m};
    double length = vec2_length(own);
    return vec2_turn((struct vec2){own.x / length, own.y / length}, box->heading);
}
