/* Places, corners and directions of a box in the world.
 *
 * Fractions (x, y) are of the box's length and width from its centre: x forward, y left, so 0.5 is
 * the front or the left side. They may lie beyond the box. */
#pragma once

#include "geometry/motion.h"

struct box {
    struct motion motion; /* of the centre */
    struct vec2 heading;  /* unit vector along the length: that of the motion's yaw */
    double length_m, width_m;
};

/* The place in the world of a point in fractions of the box. */
static inline struct vec2 box_place(const struct box *box, double x, double y)
{
    struct vec2 own = {x * box->length_m, y * box->width_m};
    return vec2_add(box->motion.position_m, vec2_turn(own, box->heading));
}

/* The four corners, counter-clockwise from the front left. */
void box_outline(const struct box *box, struct vec2 corner[4]);

/* The unit vector from one place to another, both in fractions and not equal. Along a side of the
 * box it is the heading itself or perpendicular to it, so that walls in line with one yaw share it
 * to the last bit. */
struct vec2 box_along(const struct box *box, double from_x, double from_y, double to_x,
                      double to_y);
