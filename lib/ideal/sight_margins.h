/* How far a sight stays from the border of what decides it, as a length (MODEL 2.5, 11.1).
 *
 * Each answers for both sides of its border: how far from being lost, or from not being lost. */
#ifndef SIGHT_MARGINS_H
#define SIGHT_MARGINS_H

#include "frame/reflectors.h"

/* Of a point's visibility: the angle to zero_rad, times the range. Infinite where it is seen from
 * everywhere. */
double sight_margins_facing_m(const struct box *box, enum visibility_shape shape, double facing_rad,
                              double zero_rad, struct vec2 place, struct vec2 sensor);

/* Of the foot on a side from its ends, along its unit vector as specular_point_foot has it, and of
 * the sensor from the side's line: the least, or the farthest beyond. NaN for a side of length
 * zero, which never has a foot. */
double sight_margins_foot_m(struct vec2 a, struct vec2 b, struct vec2 along, double margin_m,
                            struct vec2 sensor);

/* Between a sight line and an outline that it does not touch. */
double sight_margins_outline_m(const struct vec2 *corners, size_t count, struct vec2 from,
                               struct vec2 to);

/* How deep a sight line is in an outline that it touches: of every edge that it touches an end must
 * cross the line, or an end of the line the edge; this is the farthest of the nearest ends. */
double sight_margins_depth_m(const struct vec2 *corners, size_t count, struct vec2 from,
                             struct vec2 to);

#endif
