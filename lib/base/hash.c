#include "base/hash.h"

uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t length)
{
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < length; i++)
        hash = (hash ^ byte[i]) * UINT64_C(0x100000001b3);
    /* Marks the end of the piece, then mixes, because FNV alone leaves its high bits poor. */
    hash = (hash ^ 0x100) * UINT64_C(0x100000001b3);
    hash = (hash ^ (hash >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    hash = (hash ^ (hash >> 27)) * UINT64_C(0x94d049bb133111eb);
    return hash ^ (hash >> 31);
}

uint64_t hash_text(uint64_t hash, const char *text)
{
    return hash_bytes(hash, text, strlen(text));
}

struct hash_table hash_table_begin(size_t count, struct arena *arena)
{
    struct hash_table table = {.room = 64};
    while (table.room < 2 * count)
        table.room *= 2;
    table.slots = arena_get(arena, table.room * sizeof *table.slots);
    return table;
}
