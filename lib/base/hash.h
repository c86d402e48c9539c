/* Hashes of bytes, and tables of numbers by content. */
#pragma once

#include "base/arena.h"
#include "base/text.h"

#define HASH_START UINT64_C(0xcbf29ce484222325)

/* The 64-bit hash in random addresses and digests of documents: FNV-1a with the final mix of
 * splitmix64; adversaries can find collisions. Calls can be chained over several pieces: the end of
 * each piece is hashed too, so ("a", "bc") and ("ab", "c") differ. */
uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t length);
uint64_t hash_text(uint64_t hash, const char *text);

/* The numbers 0, 1, 2, ... of items, by open addressing in a table that is at most half full. The
 * caller keeps the items that the numbers stand for, and compares them with the wanted one. */
struct hash_table {
    uint32_t *slots; /* number + 1, or 0 */
    size_t room;     /* a power of two */
};

/* An empty table for count numbers. */
struct hash_table hash_table_begin(size_t count, struct arena *arena);

/* Mixes a word into a hash. A product spreads bits upwards only, so its upper half is folded down
 * for the next one. */
static inline uint64_t hash_table_mix(uint64_t hash, uint64_t word)
{
    const uint64_t spread = UINT64_C(0x9e3779b97f4a7c15); /* 2^64 over the golden ratio */
    hash = (hash ^ word) * spread;
    return hash ^ hash >> 32;
}

/* A quick hash of bytes, for tables in memory: no output may depend on it. A call may continue the
 * hash of an earlier one. */
static inline uint64_t hash_table_hash(uint64_t hash, const char *bytes, size_t length)
{
    if (length < 8)
        return hash_table_mix(hash + length, text_short_word(bytes, length));
    for (size_t i = 0; i + 8 < length; i += 8)
        hash = hash_table_mix(hash, text_word(bytes + i));
    return hash_table_mix(hash + length, text_word(bytes + length - 8));
}

/* The slot that holds the number of the wanted item, or the free one where it belongs. is() returns
 * true if the item of a number is the wanted one. */
static inline uint32_t *hash_table_slot(const struct hash_table *table, uint64_t hash,
                                        bool (*is)(const void *items, uint32_t number,
                                                   const void *wanted),
                                        const void *items, const void *wanted)
{
    uint64_t at = (hash >> 32) * table->room >> 32;
    for (;; at = (at + 1) & (table->room - 1)) {
        uint32_t *slot = &table->slots[at];
        if (*slot == 0 || is(items, *slot - 1, wanted))
            return slot;
    }
}
