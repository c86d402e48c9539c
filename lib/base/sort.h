/* Stable sorting that takes its scratch memory from an arena. A natural merge sort merges the runs
 * that are in order already, so a list in order costs one pass; every item is moved once, in place.
 * qsort of the C library need not be stable, and allocates. */
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
