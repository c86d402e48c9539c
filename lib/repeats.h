/* Lists that lines repeat word for word: reflector sets, above all, which hardly change in a
 * stream. What was read of them is kept with its text, and the same text is not read again. A line
 * still stands alone: this is only a quicker way to the same list. */
#ifndef REPEATS_H
#define REPEATS_H

#include "field.h"

/* No more are kept after so many, or after so many bytes of text. */
enum { REPEATS_MOST = 256, REPEATS_SIZE = 1024 * 1024 };

struct repeat {
    const struct record *record; /* of the items */
    const char *text;
    size_t length;
    LIST_OF(void) items; /* full, so that whoever adds one gets a copy */
};

/* Zeroed, it has kept nothing. */
struct repeats {
    struct arena arena;
    LIST_OF(struct repeat) kept;
    size_t size; /* of their text */
    size_t next; /* the likeliest: what came after the last one found */
};

/* The list of these items with which the text begins, or NULL. */
const struct repeat *repeats_find(struct repeats *repeats, const struct record *record,
                                  const char *text, const char *end);

bool repeats_full(const struct repeats *repeats);

/* Keeps the list member at base, which lies in the arena of repeats and was read from that text. */
void repeats_keep(struct repeats *repeats, const struct field *field, const void *base,
                  const char *text, size_t length);

void repeats_free(struct repeats *repeats);

#endif
