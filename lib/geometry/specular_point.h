/* Where a flat side mirrors the radar back at itself (MODEL 2.3).
 *
 * A side is the segment a to b of a counter-clockwise outline, so its outer face is to the right
 * of a -> b. The specular point is the foot of the perpendicular from the sensor; it exists where
 * the foot lies on the segment, ends included and shortened by margin_m at both, and the sensor is
 * strictly outside. Beyond the ends the neighbouring corner takes over.
 *
 * The ends are decided exactly, by along, the side's direction. Two sides in line that share a
 * vertex and a direction as doubles so never lose the foot at their joint, however they are turned,
 * and hold it both only where it is the vertex itself, which look.h gives to one (NUMERICS 33).
 * Their own a -> b would not do, as rounding bends the joint. Where even the vertex differs, the
 * gap or overlap of its two roundings, 1e-13 m at a kilometre, is part of the scene. */
#ifndef SPECULAR_POINT_H
#define SPECULAR_POINT_H

#include <stdbool.h>

#include "base/vec2.h"

/* True, and the foot, if the specular point exists. along is the unit vector from a to b. A segment
 * of length zero (below 1e-160 m) has none.
 *
 * The foot is rounded. On a side parallel to an axis the sight line is parallel to the other to the
 * last bit, so that an outline it touches blocks it; else it passes within 2 ulp of the largest
 * coordinate or distance, and an outline that it only touches may be missed by that. */
bool specular_point_foot(struct vec2 a, struct vec2 b, struct vec2 along, double margin_m,
                         struct vec2 sensor, struct vec2 *foot);

#endif
