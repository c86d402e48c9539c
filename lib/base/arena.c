#include "base/arena.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/diag.h"

enum { BLOCK_SIZE = 64 * 1024, ALIGNMENT = 16 };

struct arena_block {
    _Alignas(ALIGNMENT) struct arena_block *older;
    size_t size; /* bytes behind this header */
};

_Static_assert(sizeof(struct arena_block) % ALIGNMENT == 0, "blocks keep their bytes aligned");

static void *grant(void *memory, size_t size)
{
    if (memory == NULL && size > 0) {
        fprintf(stderr, "glint: out of memory: %zu bytes were refused\n", size);
        exit(DIAG_MEMORY);
    }
    return memory;
}

void *memory_get(size_t size)
{
    return grant(malloc(size), size);
}

void *memory_resize(void *memory, size_t size)
{
    return grant(realloc(memory, size), size);
}

void memory_free(void *memory)
{
    free(memory);
}

static struct arena_block *block_of(size_t size, struct arena_block *older)
{
    struct arena_block *block = memory_get(sizeof *block + size);
    block->older = older;
    block->size = size;
    return block;
}

static size_t round_up(size_t size)
{
    return (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

void *arena_room(struct arena *arena, size_t size)
{
    if (size > SIZE_MAX / 4)
        grant(NULL, size);
    size = round_up(size);
    bool fits = arena->blocks != NULL && arena->blocks->size - arena->used >= size;
    if (!fits && size > BLOCK_SIZE && arena->blocks != NULL) {
        /* A block of its own, behind the newest one, whose rest stays in use. */
        arena->blocks->older = block_of(size, arena->blocks->older);
        return arena->blocks->older + 1;
    }
    if (!fits) {
        arena->blocks = block_of(size > BLOCK_SIZE ? size : BLOCK_SIZE, arena->blocks);
        arena->used = 0;
    }
    char *memory = (char *)(arena->blocks + 1) + arena->used;
    arena->used += size;
    return memory;
}

void *arena_get(struct arena *arena, size_t size)
{
    return memset(arena_room(arena, size), 0, size);
}

char *arena_text(struct arena *arena, const char *text, size_t length)
{
    char *copy = arena_room(arena, length + 1);
    if (length > 0)
        memcpy(copy, text, length);
    copy[length] = '\0';
    return copy;
}

char *arena_format(struct arena *arena, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    size_t size = length < 0 ? 1 : (size_t)length + 1;
    char *text = arena_get(arena, size);
    va_start(arguments, format);
    vsnprintf(text, size, format, arguments);
    va_end(arguments);
    return text;
}

void arena_clear(struct arena *arena)
{
    arena->used = 0;
    if (arena->blocks == NULL || arena->blocks->older == NULL)
        return;
    size_t whole = 0;
    for (struct arena_block *block = arena->blocks; block != NULL; block = block->older)
        whole += block->size;
    arena_free(arena);
    arena->blocks = block_of(whole + whole / 2, NULL);
}

void arena_free(struct arena *arena)
{
    while (arena->blocks != NULL) {
        struct arena_block *older = arena->blocks->older;
        free(arena->blocks);
        arena->blocks = older;
    }
    arena->used = 0;
}

void *list_grow(struct arena *arena, void *items, size_t count, size_t *room, size_t size)
{
    *room = count < 4 ? 8 : 2 * count;
    void *larger = arena_room(arena, *room * size);
    return count > 0 ? memcpy(larger, items, count * size) : larger;
}
