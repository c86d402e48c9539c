/* Exact test whether a line of sight crosses an outline (MODEL 2.5, step 3).
 *
 * The test is closed: a line that touches an outline in one point, runs through a corner, along an
 * edge or through the joint of two walls is blocked. Only edges block, so a sensor inside an
 * outline sees what is inside with it and nothing beyond. The answer is exact for the given
 * coordinates. An object is never tested against its own reflectors: their visibility ranges decide
 * that. */
#pragma once

#include <stddef.h>

#include "base/vec2.h"

/* True if the closed segments p-q and a-b share a point. Segments of length zero are points. */
bool outline_crossing_segments_touch(struct vec2 p, struct vec2 q, struct vec2 a, struct vec2 b);

/* True if the closed segment from-to touches the closed polygon through the count corners. */
bool outline_crossing_blocks(const struct vec2 *corners, size_t count, struct vec2 from,
                             struct vec2 to);
