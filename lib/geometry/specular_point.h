/* Specular point of a flat side for a sensor. It is the place that mirrors the radar's wave back
 * (MODEL 2.3): the foot of the perpendicular from the sensor, after the segment is shortened by
 * margin_m at both ends. A side's outer face is to the right of a -> b.
 *
 * The ends are decided exactly, by the projection onto along, the side's direction: that of a -> b
 * would not do, because rounding bends joints. Two sides in line that share a vertex and have the
 * same direction as doubles never lose the foot at their joint; both hold the foot only where it is
 * the vertex itself, and line_of_sight.h gives it to one of them. */
#pragma once

#include "base/vec2.h"

/* True if the specular point exists; sets foot. along is the unit vector from a to b. A segment of
 * length zero (below 1e-160 m) has no specular point.
 *
 * The foot is rounded. On a side parallel to one axis the line of sight is parallel to the other
 * axis to the last bit, so an outline that it touches blocks it. On other sides the line passes
 * within 2 ulp of the largest coordinate or distance, so an outline that it only touches may be
 * missed by that. */
bool specular_point_foot(struct vec2 a, struct vec2 b, struct vec2 along, double margin_m,
                         struct vec2 sensor, struct vec2 *foot);
