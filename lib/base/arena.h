/* Memory that is never NULL, and arenas.
 *
 * Ownership in one sentence: whatever belongs to a frame lies in the frame's arena and goes when
 * the runner clears it; whatever is loaded from a document lies in the runner's arena, and what one
 * frame leaves to the next lies with the chain, and both go at the end; nothing else is allocated.
 * Out of memory says so on stderr and leaves with 71, in jansson too (document_guard_memory),
 * because a library that carries on after a failed allocation has been seen to return wrong
 * numbers. */
#ifndef ARENA_H
#define ARENA_H

#include <stddef.h>
#include <string.h>

/* malloc and realloc that end the program with 71 instead of returning NULL. */
void *memory_get(size_t size);
void *memory_resize(void *memory, size_t size);

struct arena_block;

/* A zeroed arena is empty and ready. */
struct arena {
    struct arena_block *blocks; /* newest first */
    size_t used;                /* bytes taken from the newest block */
};

/* Zeroed memory, aligned for any type, valid until the arena is cleared or freed. */
void *arena_get(struct arena *arena, size_t size);

/* The same with whatever it held before, for those who write all of it. */
void *arena_room(struct arena *arena, size_t size);

/* A NUL-terminated copy of the first length bytes of text. */
char *arena_text(struct arena *arena, const char *text, size_t length);

/* Forgets everything in the arena but keeps its room, joined into one block with half as much
 * again, so that a loop that clears its arena each round allocates nothing once a round was nearly
 * as large as they get. */
void arena_clear(struct arena *arena);

void arena_free(struct arena *arena);

/* A growing array in an arena: items, how many there are, how many fit. */
#define LIST_OF(type)                                                                              \
    struct {                                                                                       \
        type *items;                                                                               \
        size_t count, room;                                                                        \
    }

/* Appends one zeroed item to a LIST_OF and yields its address, valid until the next append. */
#define list_add(list, arena)                                                                      \
    ((list)->items =                                                                               \
         list_room((arena), (list)->items, (list)->count, &(list)->room, sizeof *(list)->items),   \
     &(list)->items[(list)->count++])

/* Makes the array larger: itself, or a copy of twice the size. */
void *list_grow(struct arena *arena, void *items, size_t count, size_t *room, size_t size);

/* Makes room for one more item and zeroes it: the array itself, or one that has grown. */
static inline void *list_room(struct arena *arena, void *items, size_t count, size_t *room,
                              size_t size)
{
    if (count == *room)
        items = list_grow(arena, items, count, room, size);
    memset((char *)items + count * size, 0, size);
    return items;
}

#endif
