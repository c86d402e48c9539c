/* Stable sorting that takes its scratch memory from an arena. libc's qsort allocates for anything
 * over a kilobyte and may or may not be stable. This merge sort merges the runs that are in order
 * already, of which a frame's lists have few, and moves every item once. A list in order costs one
 * pass. */
#pragma once

#include "base/arena.h"

/* Sorts count items of size bytes; compare as for qsort. */
void sort_items(void *items, size_t count, size_t size, int (*compare)(const void *, const void *),
                struct arena *arena);

/* Sorts numbers in ascending order; none is NaN. */
void sort_numbers(double *numbers, size_t count, struct arena *arena);

/* Sorts a LIST_OF. */
#define sort_list(list, compare, arena)                                                            \
    sort_items((list)->items, (list)->count, sizeof *(list)->items, (compare), (arena))
