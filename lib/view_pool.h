/* Pieces of text or bytes, each kept once and known by its number: 0, 1, 2, ... in the order in
 * which they first came. All memory is the arena's. A zeroed pool is empty. */
#ifndef VIEW_POOL_H
#define VIEW_POOL_H

#include <stdint.h>

#include "memory.h"

struct view_piece {
    const char *bytes; /* NUL-terminated */
    size_t length;
    uint64_t hash;
};

struct view_pool {
    LIST_OF(struct view_piece) pieces;
    uint32_t *slots; /* open addressing: number + 1, or 0 */
    size_t slot_count;
};

uint32_t view_pool_number(struct view_pool *pool, const void *bytes, size_t length,
                          struct arena *arena);
uint32_t view_pool_word(struct view_pool *pool, const char *word, struct arena *arena);

#endif
