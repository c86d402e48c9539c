/* Marks of targets: shapes, colours and kinds.
 *
 * A target has the shape and colour of its sensor, by number; both begin again after the last. Its
 * kind is that of its first echo: "body", "ghost", "clutter" or "false_alarm". Shapes of bodies are
 * filled, but the circle is a ring; shapes of ghosts are hollow and dashed. Three dots mark
 * clutter, an asterisk a false alarm, and a cross a lost echo. */
#pragma once

#include "frame/frame.h"

struct view_shape {
    int64_t corners; /* 0: a circle */
    double inner;    /* radius of a star's inner corners, where its tips have 1; 0: a polygon */
    double turn_rad; /* of the first corner, clockwise from the top */
    double size;     /* radius of the shape in radii of a mark */
};

enum { VIEW_SHAPES = 6, VIEW_COLOURS = 8 };

extern const struct view_shape view_marks_shapes[VIEW_SHAPES];
extern const char *const view_marks_light[VIEW_COLOURS], *const view_marks_dark[VIEW_COLOURS];

/* The kind of a target whose first echo came on this path. */
const char *view_marks_kind(enum path path);
