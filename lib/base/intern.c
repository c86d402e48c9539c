#include "base/intern.h"

#include "base/text.h"

static inline bool is_name(const void *names, uint32_t number, const void *wanted)
{
    const struct intern_name *a = (const struct intern_name *)names + number, *b = wanted;
    return a->length == b->length && memcmp(a->text, b->text, a->length) == 0;
}

static inline uint32_t *slot_of(const struct intern *names, const struct intern_name *name)
{
    uint64_t hash = hash_table_hash(0, name->text, name->length);
    return hash_table_slot(&names->numbers, hash, is_name, names->list.items, name);
}

static void grow(struct intern *names, struct arena *arena)
{
    names->numbers = hash_table_begin(names->numbers.room, arena);
    for (uint32_t i = 0; i < names->list.count; i++)
        *slot_of(names, &names->list.items[i]) = i + 1;
}

struct intern intern_begin(size_t expected, struct arena *arena)
{
    return (struct intern){.numbers = hash_table_begin(expected, arena)};
}

uint32_t intern_number(struct intern *names, const void *text, size_t length, struct arena *arena)
{
    if (2 * names->list.count >= names->numbers.room)
        grow(names, arena);
    struct intern_name name = {text, length};
    uint32_t *slot = slot_of(names, &name);
    if (*slot == 0) {
        name.text = arena_text(arena, text, length);
        *list_add(&names->list, arena) = name;
        *slot = (uint32_t)names->list.count;
    }
    return *slot - 1;
}

bool intern_find(const struct intern *names, const void *text, size_t length, uint32_t *number)
{
    if (names->list.count == 0)
        return false;
    struct intern_name name = {text, length};
    uint32_t slot = *slot_of(names, &name);
    *number = slot - 1;
    return slot != 0;
}

uint32_t intern_word(struct intern *names, const char *word, struct arena *arena)
{
    return intern_number(names, word, strlen(word), arena);
}
