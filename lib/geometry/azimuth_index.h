/* Index of bodies by azimuth sector. A question about one direction then concerns few of many
 * bodies.
 *
 * The horizon around a sensor is cut into sectors. Each sector, or group of neighbouring sectors,
 * has the set of the bodies, by number, whose silhouettes reach into it. A search answers with
 * every body whose silhouette has one of the sectors searched, and possibly more. Sets are bits, 64
 * to a word: they are joined a word at a time and come out in ascending order. */
#pragma once

#include "base/arena.h"
#include "geometry/silhouette.h"

struct azimuth_index {
    unsigned shift; /* from a sector's number to its set's, to the right */
    size_t words;   /* per set */
    uint64_t *sets; /* in counter-clockwise order of their sectors */
    size_t *found;  /* numbers, ascending: the result of the last search */
};

/* A run of sectors, counter-clockwise from the first. */
struct azimuth_index_span {
    unsigned first, count;
};

extern const struct azimuth_index_span azimuth_index_everywhere;

/* Every sector in which the silhouette has a direction; all sectors if the sensor is too near for a
 * silhouette. */
struct azimuth_index_span azimuth_index_of(const struct silhouette *silhouette);

/* Every sector through which a straight line between two places runs, as seen from the sensor at
 * the origin. */
struct azimuth_index_span azimuth_index_between(struct vec2 from_m, struct vec2 to_m);

/* An index without entries, for numbers below count. */
struct azimuth_index azimuth_index_begin(size_t count, struct arena *arena);

void azimuth_index_enter(struct azimuth_index *index, size_t number,
                         struct azimuth_index_span span);

/* Writes to found all numbers that were entered in any sector of the span; returns how many. */
size_t azimuth_index_find(const struct azimuth_index *index, struct azimuth_index_span span);
