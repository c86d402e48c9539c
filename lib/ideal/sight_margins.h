/* Distances from the borders of visibility, specular points and outlines.
 *
 * All are in metres and positive on both sides of a border, 0 on it: how far a reflector is from
 * being lost, or from not being lost (MODEL 2.5, 11.1). */
#pragma once

#include "frame/reflectors.h"

/* From the border of a point's visibility: the angle to zero_rad, times the range. Infinite for a
 * point that is seen from everywhere. */
double sight_margins_facing_m(const struct box *box, enum visibility_shape shape, double facing_rad,
                              double zero_rad, struct vec2 place, struct vec2 sensor);

/* From losing or gaining the specular point on the side a to b, with unit vector along
 * (mirror_specular_point). If there is one: the lesser of the foot's distance from the nearer
 * shortened end and the sensor's distance from the side's line. If there is none: the greatest of
 * the distances by which foot and sensor are beyond those borders. NaN for a side of length zero,
 * which never has a foot. */
double sight_margins_foot_m(struct vec2 a, struct vec2 b, struct vec2 along, double margin_m,
                            struct vec2 sensor);

/* Distance of a sight line from an outline that it does not touch. */
double sight_margins_outline_m(const struct vec2 *corners, size_t count, struct vec2 from,
                               struct vec2 to);

/* Depth of a sight line in an outline that it touches. To clear an edge that it touches, an end of
 * the edge must cross the line or an end of the line the edge; the depth is the distance of the
 * nearest such end, from the edge where that is farthest. */
double sight_margins_depth_m(const struct vec2 *corners, size_t count, struct vec2 from,
                             struct vec2 to);
