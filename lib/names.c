#include "names.h"

#include <string.h>

#include "text.h"

enum { TRIES = 4 };

struct names_slot {
    const char *text;
    size_t length;
};

struct names names_begin(struct arena *arena, size_t expected)
{
    size_t count = 64;
    while (count < 2 * expected)
        count *= 2;
    return (struct names){arena, arena_get(arena, count * sizeof(struct names_slot)), count};
}

/* Of the first and the last eight bytes, which are all of a short name. */
static uint64_t hash_ends(const char *text, size_t length)
{
    const uint64_t spread = UINT64_C(0x9e3779b97f4a7c15); /* 2^64 over the golden ratio */
    uint64_t first = text_short_word(text, length < 8 ? length : 8);
    uint64_t last = length > 8 ? text_word(text + length - 8) : length;
    return (first * spread ^ last) * spread >> 32;
}

const char *names_keep(struct names *names, const char *text, size_t length)
{
    uint64_t hash = hash_ends(text, length);
    struct names_slot *slot = NULL;
    for (uint64_t i = 0; i < TRIES; i++) {
        slot = &names->slots[(hash + i) & (names->count - 1)];
        if (slot->text == NULL)
            break;
        if (slot->length == length && memcmp(slot->text, text, length) == 0)
            return slot->text;
    }
    *slot = (struct names_slot){arena_text(names->arena, text, length), length};
    return slot->text;
}
