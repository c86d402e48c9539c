#include "base/hash_table.h"

struct hash_table hash_table_begin(size_t count, struct arena *arena)
{
    struct hash_table table = {.room = 64};
    while (table.room < 2 * count)
        table.room *= 2;
    table.slots = arena_get(arena, table.room * sizeof *table.slots);
    return table;
}
