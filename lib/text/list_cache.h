/* Cache of lists that a stream repeats word for word. Reflector sets, above all, hardly change from
 * frame to frame. A list that was read is kept with its text, so that the same text is not read
 * again; the text of a list that was written is kept, so that the same list is not formatted again.
 * The cache only saves time: each line is complete and is read and written as without it. */
#pragma once

#include "text/field.h"

/* The largest number of lists kept, and of bytes of text after which none is added. */
enum { LIST_CACHE_MOST = 256, LIST_CACHE_SIZE = 1024 * 1024 };

/* A list that does not change any more: it was read from a line, or belongs to a document. */
struct list_cache_entry {
    const struct record *record; /* record of the items */
    LIST_OF(void) items;         /* without spare room, so that a list_add makes a copy */
    struct field_text read;      /* text of the list in the line it was read from */
    struct field_text written;   /* text of the list in lines that are written */
    const void *document;        /* a struct that was checked and has this list first, or NULL */
};

/* A zeroed cache is empty. All its memory is its arena's. */
struct list_cache {
    struct arena arena;
    LIST_OF(struct list_cache_entry) kept;
    size_t size; /* bytes of all texts */
    size_t next; /* index after the list found last: the one that is searched first */
};

/* The list of such items at the beginning of the text, or NULL. */
const struct list_cache_entry *list_cache_find(struct list_cache *cache,
                                               const struct record *record, const char *text,
                                               const char *end);

bool list_cache_full(const struct list_cache *cache);

/* Keeps the list member at base, which lies in the cache's arena and was read from this text. */
void list_cache_keep(struct list_cache *cache, const struct field *field, const void *base,
                     const char *text, size_t length);

/* The cached list of the steady list member of the struct at base, found by its address, or added
 * if it is a document's. NULL for any other list, because its memory may hold another list in the
 * next frame, and when the cache is full. Two lists at one address, of whatever records, are both
 * empty. */
struct list_cache_entry *list_cache_of(struct list_cache *cache, const struct record *record,
                                       const struct field *field, const void *base);

/* Keeps the text that was written of a list, unless the cache has too much text already. */
void list_cache_keep_written(struct list_cache *cache, struct list_cache_entry *list,
                             const char *text, size_t length);
