#include "base/numbering.h"

#include <string.h>

#include "base/hash.h"

/* The slot that holds these bytes, or the free one where they belong. */
static uint32_t *slot_of(const struct numbering *pool, const void *bytes, size_t length,
                         uint64_t hash)
{
    for (size_t at = hash % pool->slot_count;; at = (at + 1) % pool->slot_count) {
        uint32_t *slot = &pool->slots[at];
        if (*slot == 0)
            return slot;
        const struct numbering_piece *piece = &pool->pieces.items[*slot - 1];
        if (piece->hash == hash && piece->length == length &&
            memcmp(piece->bytes, bytes, length) == 0)
            return slot;
    }
}

static void grow(struct numbering *pool, struct arena *arena)
{
    pool->slot_count = pool->slot_count == 0 ? 64 : 2 * pool->slot_count;
    pool->slots = arena_get(arena, pool->slot_count * sizeof *pool->slots);
    for (size_t i = 0; i < pool->pieces.count; i++) {
        const struct numbering_piece *piece = &pool->pieces.items[i];
        *slot_of(pool, piece->bytes, piece->length, piece->hash) = (uint32_t)i + 1;
    }
}

uint32_t numbering_of(struct numbering *pool, const void *bytes, size_t length, struct arena *arena)
{
    if (2 * pool->pieces.count >= pool->slot_count)
        grow(pool, arena);
    uint64_t hash = hash_bytes(HASH_START, bytes, length);
    uint32_t *slot = slot_of(pool, bytes, length, hash);
    if (*slot == 0) {
        *list_add(&pool->pieces, arena) =
            (struct numbering_piece){arena_text(arena, bytes, length), length, hash};
        *slot = (uint32_t)pool->pieces.count;
    }
    return *slot - 1;
}

uint32_t numbering_of_word(struct numbering *pool, const char *word, struct arena *arena)
{
    return numbering_of(pool, word, strlen(word), arena);
}
