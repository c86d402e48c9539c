/* Obstruction of sight lines by a body; knife-edge diffraction (MODEL 2.5, 14.3, 14.4).
 *
 * A body is an upright prism over the convex outline through count corners, counter-clockwise, from
 * bottom_m to top_m above the road. A top_m of INFINITY is the flat world, in which no line passes
 * above anything; below a bottom_m of 0 none passes either. A line that the road mirrors is
 * unfolded (MODEL 14.3): its heights behind the road are negative, where the body's image stands.
 * Only the way under a body counts them so.
 *
 * Whether a line touches the outline is exact for the given coordinates (predicates.h). A line is
 * blocked also if it touches an outline in one point only, at a corner, along an edge or at the
 * joint of two walls. Only edges block, so a sensor inside an outline sees all that is inside and
 * nothing beyond. Bodies are never tested against their own reflectors. Heights are compared as
 * doubles: a line within some 1e-15 m of a top may be blocked or free. */
#pragma once

#include "base/vec2.h"

/* True if the closed segments p-q and a-b share a point. Segments of length zero are points. */
bool obstruction_segments_touch(struct vec2 p, struct vec2 q, struct vec2 a, struct vec2 b);

/* True if the closed segment from-to touches the closed polygon through the count corners. */
bool obstruction_blocks(const struct vec2 *corners, size_t count, struct vec2 from, struct vec2 to);

/* A straight line between two places and their heights. */
struct obstruction_line {
    struct vec2 from, to;
    double from_height_m, to_height_m;
};

/* The heights of a body over the road. */
struct obstruction_heights {
    double bottom_m, top_m;
};

/* The height by which a line that touches the outline passes above the body's top or below its
 * bottom all along, the greater of both; negative if it does neither. */
double obstruction_clear_m(const struct vec2 *corners, size_t count,
                           struct obstruction_heights body, const struct obstruction_line *line);

struct obstruction {
    double factor; /* on amplitude, both ways together, in [0, 1] */
    bool bent;     /* diffraction changes the factor */
    bool over;     /* the body's height or its clearance changes the factor */
};

/* The obstruction of a line by a body.
 *
 * Without diffraction (wavelength_m 0) the factor is 0 for a line that touches the outline and is
 * neither above the top nor below the bottom all along, and 1 for every other line. A line inside
 * the outline from end to end is free.
 *
 * With diffraction the body is a knife edge on the path with the least loss: to the left, to the
 * right, over the top or under the bottom. The edge of a side is the corner with the largest nu,
 * for the distances of the corner's foot on the line from both ends; if the line does not touch the
 * outline, only corners between both ends count. From two Fresnel radii inside the shadow on, nu >=
 * 2 sqrt(2), the factor is 0. */
struct obstruction obstruction_of(const struct vec2 *corners, size_t count,
                                  struct obstruction_heights body,
                                  const struct obstruction_line *line, double wavelength_m);

/* The diffraction parameter of ITU-R P.526, nu = depth sqrt(2 (d1 + d2)/(lambda d1 d2)). depth_m is
 * the depth of the sight line in the shadow at the edge, negative outside; d1 and d2 are the
 * distances from the edge to sensor and reflector, at least 0.1 m each; wavelength > 0.
 */
double obstruction_edge_parameter(double depth_m, double sensor_side_m, double reflector_side_m,
                                  double wavelength_m);

/* The factor on amplitude for both ways, 10^(-2 J/20), in [0, 1]. J(nu) = 6.9 + 20 lg(sqrt((nu -
 * 0.1)^2 + 1) + nu - 0.1) dB is the loss of one way, 0 dB up to nu = -0.78, where the factor is
 * exactly 1. J is within 0.15 dB of Fresnel's integral from nu = -0.77 to 12. */
double obstruction_edge_amplitude_factor(double parameter);

/* The largest first Fresnel radius along a sight line of length range_m: an edge farther away does
 * not change the factor. 0 for a wavelength of 0. */
double obstruction_edge_reach_m(double range_m, double wavelength_m);
