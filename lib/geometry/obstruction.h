/* What a body in the way lets through of a sight line: nothing or all of it (MODEL 2.5), more if
 * the line runs over the body, or a part where it runs close to the body's edge (EFFECTS 16).
 *
 * A body is an upright prism over the convex outline through count corners, counter-clockwise, up
 * to top_m; INFINITY is the flat world, in which nothing is seen over anything. Whether the line
 * touches the outline is exact for the given coordinates (outline_crossing.h); heights are compared
 * as plain doubles, which decide a line that grazes a top by the rounding of its height, some 1e-15
 * m. */
#ifndef OBSTRUCTION_H
#define OBSTRUCTION_H

#include <stdbool.h>
#include <stddef.h>

#include "base/vec2.h"

/* A straight line between two places and their heights. */
struct obstruction_line {
    struct vec2 from, to;
    double from_height_m, to_height_m;
};

/* How far the line stays above the body's top where it is over it, at its lowest; negative below
 * the top. Only of a line that touches the outline. */
double obstruction_above_m(const struct vec2 *corners, size_t count, double top_m,
                           const struct obstruction_line *line);

struct obstruction {
    double factor; /* on amplitude, there and back, in [0, 1] */
    bool bent;     /* without diffraction it would be another */
    bool over;     /* beside a body without a top it would be another */
};

/* What comes through.
 *
 * Without diffraction (wavelength_m 0) the body blocks, 0, a line that touches its outline and is
 * not above its top somewhere in it; otherwise the factor is 1. The test is closed, as in the flat
 * world. A line inside the outline from end to end is free.
 *
 * With diffraction the body is a knife edge, at the one of its edges that is the easiest way round:
 * to the left, to the right or over the top. To either side that edge is the corner that reaches
 * farthest into the line, as counted by nu (knife_edge.h) with the distances of the corner's foot
 * on the line from both ends; beside a body only corners between both ends count. From two Fresnel
 * radii inside the shadow on, nu >= 2 sqrt(2), nothing is left. */
struct obstruction obstruction_of(const struct vec2 *corners, size_t count, double top_m,
                                  const struct obstruction_line *line, double wavelength_m);

#endif
