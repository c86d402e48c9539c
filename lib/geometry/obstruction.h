/* Part of an echo that a single body lets through (MODEL 2.5, 14.3, 14.4).
 *
 * A body is an upright prism over the convex outline through count corners, counter-clockwise, up
 * to top_m. A top_m of INFINITY is the flat world, in which no line passes above anything. Whether
 * the line touches the outline is exact for the given coordinates (outline_crossing.h). Heights are
 * compared as plain doubles, so rounding, some 1e-15 m, decides a line that grazes a top. */
#pragma once

#include <stddef.h>

#include "base/vec2.h"

/* A straight line between two places and their heights. */
struct obstruction_line {
    struct vec2 from, to;
    double from_height_m, to_height_m;
};

/* The least height of the line above the body's top where it is over the body; negative below the
 * top. Only for a line that touches the outline. */
double obstruction_above_m(const struct vec2 *corners, size_t count, double top_m,
                           const struct obstruction_line *line);

struct obstruction {
    double factor; /* on amplitude, both ways together, in [0, 1] */
    bool bent;     /* diffraction changes the factor */
    bool over;     /* the body's height changes the factor */
};

/* The obstruction of a line by a body.
 *
 * Without diffraction (wavelength_m 0) the body blocks, with the factor 0, a line that touches its
 * outline and is not above its top all along; for other lines the factor is 1. The test is closed,
 * as in the flat world. A line inside the outline from end to end is free.
 *
 * With diffraction the body is a knife edge at the easiest of the ways round it: to the left, to
 * the right or over the top. To either side the edge is the corner that reaches farthest into the
 * line, measured by nu (knife_edge.h) with the distances of the corner's foot on the line from both
 * ends; if the line does not touch the outline, only corners between both ends count. From two
 * Fresnel radii inside the shadow on, nu >= 2 sqrt(2), the factor is 0. */
struct obstruction obstruction_of(const struct vec2 *corners, size_t count, double top_m,
                                  const struct obstruction_line *line, double wavelength_m);
