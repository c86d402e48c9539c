/* Marks of targets, in the page and in stills.
 *
 * A target's shape and colour are those of its sensor, by number; both begin again after the last.
 * Its kind says what it is an echo of: "body", "ghost", "clutter" or "false_alarm". A body's shape
 * is filled, a circle is a ring; a ghost's is hollow and dashed; three dots are clutter, and an
 * asterisk is a false alarm. A cross marks a lost echo. */
#pragma once

#include "frame/frame.h"

struct view_shape {
    int64_t corners; /* 0: a circle */
    double inner;    /* radius of the corners between those of a star, 1 at its tips; 0: none */
    double turn_rad; /* of the first corner, clockwise from the top */
    double size;     /* radius of the shape, where that of a mark is 1 */
};

enum { VIEW_SHAPES = 6, VIEW_COLOURS = 8 };

extern const struct view_shape view_marks_shapes[VIEW_SHAPES];
extern const char *const view_marks_light[VIEW_COLOURS], *const view_marks_dark[VIEW_COLOURS];

/* The kind of a target whose first echo came on this path. */
const char *view_marks_kind(enum path path);
