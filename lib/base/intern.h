/* Names, each kept once and known by its number. Numbers are 0, 1, 2, ... in the order in which the
 * names first came.
 *
 * A name may hold any bytes, for instance those of a struct of numbers. A zeroed struct is empty.
 * All memory is the arena's, which must be the same one at every call. */
#pragma once

#include "base/hash.h"

struct intern_name {
    const char *text; /* NUL-terminated */
    size_t length;
};

struct intern {
    LIST_OF(struct intern_name) list;
    struct hash_table numbers;
};

/* An empty table with room for about as many different names. */
struct intern intern_begin(size_t expected, struct arena *arena);

/* The number of a name of length bytes, or of one that ends with NUL. */
uint32_t intern_number(struct intern *names, const void *text, size_t length, struct arena *arena);
uint32_t intern_word(struct intern *names, const char *word, struct arena *arena);

/* The number of a name that is there; false if it is not. */
bool intern_find(const struct intern *names, const void *text, size_t length, uint32_t *number);

/* The name of that number: equal names are one pointer. */
static inline const char *intern_text(const struct intern *names, uint32_t number)
{
    return names->list.items[number].text;
}
