/* Arenas, growing arrays, and memory that is never NULL.
 *
 * Ownership: the data of a frame lie in the frame's arena, which the runner clears after each
 * frame. Documents lie in the runner's arena, and data that one frame leaves to the next in the
 * chain's arena; both are freed at the end. When memory runs out, also in jansson
 * (document_guard_memory), the program prints a message on stderr and exits with 71. */
#pragma once

#include <stddef.h>
#include <string.h>

/* malloc and realloc that exit with 71 instead of returning NULL. */
void *memory_get(size_t size);
void *memory_resize(void *memory, size_t size);

/* Frees what either has given; NULL: nothing. */
void memory_free(void *memory);

struct arena_block;

/* A zeroed arena is empty and ready. */
struct arena {
    struct arena_block *blocks; /* the newest one first, but for large ones behind it */
    size_t used;                /* bytes taken from the newest block */
};

/* Zeroed memory, aligned for any type, valid until the arena is cleared or freed. */
void *arena_get(struct arena *arena, size_t size);

/* Like arena_get, but not zeroed, for callers that write all of it. */
void *arena_room(struct arena *arena, size_t size);

/* A NUL-terminated copy of the first length bytes of text. */
char *arena_text(struct arena *arena, const char *text, size_t length);

/* The text that printf would print. */
char *arena_format(struct arena *arena, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Empties the arena. Several blocks become one of 1.5 times their size, so that a loop that clears
 * its arena each round soon allocates nothing. */
void arena_clear(struct arena *arena);

void arena_free(struct arena *arena);

/* A growing array in an arena: items, the number of items, and the number that fits. */
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

/* A larger copy of the array, with room for at least one more item. */
void *list_grow(struct arena *arena, void *items, size_t count, size_t *room, size_t size);

/* Makes room for one more item and zeroes it; returns the array, which may have moved. */
static inline void *list_room(struct arena *arena, void *items, size_t count, size_t *room,
                              size_t size)
{
    if (count == *room)
        items = list_grow(arena, items, count, room, size);
    memset((char *)items + count * size, 0, size);
    return items;
}
