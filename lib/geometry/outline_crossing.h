/* What stands in the way (MODEL 2.5, step 3; NUMERICS A3 29 to 32).
 *
 * The test is closed: a sight line that touches an outline in one point, runs through a corner,
 * along an edge or through the joint of two walls is blocked. Only edges block, so a sensor inside
 * an outline sees what is inside with it and nothing beyond. The answer is exact for the given
 * coordinates. Never asked of an object about itself: its visibility ranges decide that. */
#ifndef OUTLINE_CROSSING_H
#define OUTLINE_CROSSING_H

#include <stdbool.h>
#include <stddef.h>

#include "base/vec2.h"

/* Do the closed segments p-q and a-b share a point? Segments of length zero are points. */
bool outline_crossing_segments_touch(struct vec2 p, struct vec2 q, struct vec2 a, struct vec2 b);

/* Does the closed segment from-to touch the closed polygon line through the count corners? */
bool outline_crossing_blocks(const struct vec2 *corners, size_t count, struct vec2 from,
                             struct vec2 to);

#endif
