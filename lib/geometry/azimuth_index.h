/* Who may stand in which direction, so that a question about one direction asks few of many.
 *
 * The horizon around a sensor is cut into slices. Each, or a few side by side, have a set of those,
 * by number, whose silhouettes reach into it; what a question gets is every number whose silhouette
 * has one of the slices it is about, and some more. Sets are bits, 64 to a word: they join in one
 * step a word and come out in ascending order. */
#ifndef AZIMUTH_INDEX_H
#define AZIMUTH_INDEX_H

#include <stdint.h>

#include "base/arena.h"
#include "geometry/silhouette.h"

struct azimuth_index {
    unsigned shift; /* from a slice's number to its set's */
    size_t words;   /* of a set */
    uint64_t *sets; /* counter-clockwise */
    size_t *found;  /* numbers, ascending: the answer to the last question */
};

/* Slices, counter-clockwise from the first. */
struct azimuth_index_span {
    unsigned first, count;
};

extern const struct azimuth_index_span azimuth_index_everywhere;

/* Every slice that a silhouette has a direction in; all of them if the sensor is too near for one.
 */
struct azimuth_index_span azimuth_index_of(const struct silhouette *silhouette);

/* Every slice in which a straight line between two places runs, as seen from the sensor. */
struct azimuth_index_span azimuth_index_between(struct vec2 from_m, struct vec2 to_m);

/* Empty sets of numbers below count. */
struct azimuth_index azimuth_index_begin(size_t count, struct arena *arena);

void azimuth_index_enter(struct azimuth_index *bearings, size_t number,
                         struct azimuth_index_span span);

/* Finds all that were entered into any slice of the span, and says how many. */
size_t azimuth_index_find(const struct azimuth_index *bearings, struct azimuth_index_span span);

#endif
