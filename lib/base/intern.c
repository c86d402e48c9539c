#include "base/intern.h"

#include <stdbool.h>
#include <string.h>

#include "base/text.h"

enum { TRIES = 4 };

/* The first and the last eight bytes, which may overlap, are all of most names; of a short one the
 * first are. */
struct names_ends {
    uint64_t first, last;
};

struct intern_slot {
    const char *text;
    size_t length;
    struct names_ends ends;
};

struct intern intern_begin(struct arena *arena, size_t expected)
{
    size_t count = 64;
    while (count < 2 * expected)
        count *= 2;
    return (struct intern){arena, arena_get(arena, count * sizeof(struct intern_slot)), count};
}

static struct names_ends ends_of(const char *text, size_t length)
{
    if (length < 8)
        return (struct names_ends){text_short_word(text, length), 0};
    return (struct names_ends){text_word(text), text_word(text + length - 8)};
}

static uint64_t hash_ends(struct names_ends ends, size_t length)
{
    const uint64_t spread = UINT64_C(0x9e3779b97f4a7c15); /* 2^64 over the golden ratio */
    return ((ends.first * spread ^ ends.last) + length) * spread >> 32;
}

static bool is_in(const struct intern_slot *slot, struct names_ends ends, const char *text,
                  size_t length)
{
    return slot->ends.first == ends.first && slot->ends.last == ends.last &&
           slot->length == length && (length <= 16 || memcmp(slot->text, text, length) == 0);
}

const char *intern_keep(struct intern *names, const char *text, size_t length)
{
    struct names_ends ends = ends_of(text, length);
    uint64_t hash = hash_ends(ends, length);
    struct intern_slot *slot = NULL;
    for (uint64_t i = 0; i < TRIES; i++) {
        slot = &names->slots[(hash + i) & (names->count - 1)];
        if (slot->text == NULL)
            break;
        if (is_in(slot, ends, text, length))
            return slot->text;
    }
    *slot = (struct intern_slot){arena_text(names->arena, text, length), length, ends};
    return slot->text;
}

const char *intern_keep_quoted(struct intern *names, const char *text, const char *end,
                               size_t *length)
{
    size_t plain = text_plain(text, (size_t)(end - text));
    if (plain == 0 || text + plain == end || text[plain] != '"')
        return NULL;
    *length = plain;
    return intern_keep(names, text, plain);
}
