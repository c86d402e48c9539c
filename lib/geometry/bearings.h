/* Who may stand in which direction, so that a question about one direction asks few of many.
 *
 * The horizon around a sensor is cut into slices. Each, or a few side by side, have a set of those,
 * by number, whose silhouettes reach into it; what a question gets is every number whose silhouette
 * has one of the slices it is about, and some more. Sets are bits, 64 to a word: they join in one
 * step a word and come out in ascending order. */
#ifndef BEARINGS_H
#define BEARINGS_H

#include <stdint.h>

#include "memory.h"
#include "silhouette.h"

struct bearings {
    unsigned shift; /* from a slice's number to its set's */
    size_t words;   /* of a set */
    uint64_t *sets; /* counter-clockwise */
    size_t *found;  /* numbers, ascending: the answer to the last question */
};

/* Slices, counter-clockwise from the first. */
struct bearings_span {
    unsigned first, count;
};

extern const struct bearings_span bearings_everywhere;

/* Every slice that a silhouette has a direction in; all of them if the sensor is too near for one.
 */
struct bearings_span bearings_of(const struct silhouette *silhouette);

/* Every slice in which a straight line between two places runs, as seen from the sensor. */
struct bearings_span bearings_between(struct vec2 from_m, struct vec2 to_m);

/* Empty sets of numbers below count. */
struct bearings bearings_begin(size_t count, struct arena *arena);

void bearings_enter(struct bearings *bearings, size_t number, struct bearings_span span);

/* Finds all that were entered into any slice of the span, and says how many. */
size_t bearings_find(const struct bearings *bearings, struct bearings_span span);

#endif
