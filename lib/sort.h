/* Sorting without malloc: libc's qsort allocates for anything over a kilobyte, and may or may not
 * be stable. This merge sort is stable and takes its scratch from an arena; what is sorted already,
 * as most of a frame is, costs one pass. */
#ifndef SORT_H
#define SORT_H

#include "memory.h"

/* Sorts count items of size bytes; compare as for qsort. */
void sort_items(void *items, size_t count, size_t size, int (*compare)(const void *, const void *),
                struct arena *arena);

/* The same for a LIST_OF. */
#define sort_list(list, compare, arena)                                                            \
    sort_items((list)->items, (list)->count, sizeof *(list)->items, (compare), (arena))

#endif
