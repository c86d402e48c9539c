/* Lists that a stream repeats word for word: reflector sets, above all, which hardly change. What
 * was read of them is kept with its text, and the same text is not read again; and their text is
 * kept once it was written, and the same list is not written out again. A line still stands alone:
 * this is only a quicker way to the same list, and to the same line. */
#ifndef LIST_CACHE_H
#define LIST_CACHE_H

#include "text/field.h"

/* No more are kept after so many, or after so many bytes of text. */
enum { LIST_CACHE_MOST = 256, LIST_CACHE_SIZE = 1024 * 1024 };

struct list_cache_text {
    const char *bytes; /* NULL: not yet */
    size_t length;
};

/* A list that never changes: one read from a line, or a document's. */
struct repeat {
    const struct record *record;    /* of the items */
    LIST_OF(void) items;            /* full, so that whoever adds one gets a copy */
    struct list_cache_text read;    /* as it stood in a line */
    struct list_cache_text written; /* as lines have it */
};

/* Zeroed, it has kept nothing. */
struct list_cache {
    struct arena arena;
    LIST_OF(struct repeat) kept;
    size_t size; /* of their text */
    size_t next; /* the likeliest: what came after the last one found */
};

/* The list of these items with which the text begins, or NULL. */
const struct repeat *list_cache_find(struct list_cache *repeats, const struct record *record,
                                     const char *text, const char *end);

bool list_cache_full(const struct list_cache *repeats);

/* Keeps the list member at base, which lies in the arena of repeats and was read from that text. */
void list_cache_keep(struct list_cache *repeats, const struct field *field, const void *base,
                     const char *text, size_t length);

/* What is kept of the steady list of the struct at base, by its address: of one that was read, or
 * is a document's. NULL of any other, whose memory may hold another list in the next frame, and of
 * those that are too many. Two lists at one address, of whatever records, are both empty. */
struct repeat *list_cache_of(struct list_cache *repeats, const struct record *record,
                             const struct field *field, const void *base);

/* Keeps what was written of it, unless there is too much already. */
void list_cache_keep_written(struct list_cache *repeats, struct repeat *repeat, const char *text,
                             size_t length);

void list_cache_free(struct list_cache *repeats);

#endif
