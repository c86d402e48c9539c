/* Where a flat side mirrors the radar back at itself (MODEL 2.3).
 *
 * A side is the segment a to b of a counter-clockwise outline, so its outer face is to the right
 * of a -> b. The specular point is the foot of the perpendicular from the sensor; it exists where
 * the foot lies on the segment, ends included and shortened by margin_m at both, and the sensor is
 * strictly outside. Beyond the ends the neighbouring corner takes over. */
#ifndef REFLECTION_H
#define REFLECTION_H

#include <stdbool.h>

#include "vec2.h"

/* True, and the foot, if the specular point exists. A segment of length zero has none. */
bool reflection_foot(struct vec2 a, struct vec2 b, double margin_m, struct vec2 sensor,
                     struct vec2 *foot);

#endif
