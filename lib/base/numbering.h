/* Pieces of text or bytes, each kept once and known by its number: 0, 1, 2, ... in the order in
 * which they first came. All memory is the arena's. A zeroed pool is empty. */
#ifndef NUMBERING_H
#define NUMBERING_H

#include <stdint.h>

#include "base/arena.h"

struct numbering_piece {
    const char *bytes; /* NUL-terminated */
    size_t length;
    uint64_t hash;
};

struct numbering {
    LIST_OF(struct numbering_piece) pieces;
    uint32_t *slots; /* open addressing: number + 1, or 0 */
    size_t slot_count;
};

uint32_t numbering_of(struct numbering *pool, const void *bytes, size_t length,
                      struct arena *arena);
uint32_t numbering_of_word(struct numbering *pool, const char *word, struct arena *arena);

#endif
