#include "text/list_cache.h"

#include <string.h>

/* Frames ask in the same order for the same lists, by text and by address alike. */
static struct repeat *likeliest(const struct list_cache *repeats, size_t tries)
{
    return &repeats->kept.items[(repeats->next + tries) % repeats->kept.count];
}

static struct repeat *found(struct list_cache *repeats, struct repeat *repeat)
{
    repeats->next = (size_t)(repeat - repeats->kept.items) + 1;
    return repeat;
}

static bool begins_with(const char *text, const char *end, struct list_cache_text beginning)
{
    return beginning.bytes != NULL && beginning.length <= (size_t)(end - text) &&
           memcmp(beginning.bytes, text, beginning.length) == 0;
}

const struct repeat *list_cache_find(struct list_cache *repeats, const struct record *record,
                                     const char *text, const char *end)
{
    for (size_t i = 0; i < repeats->kept.count; i++) {
        struct repeat *repeat = likeliest(repeats, i);
        if (repeat->record == record && begins_with(text, end, repeat->read))
            return found(repeats, repeat);
    }
    return NULL;
}

bool list_cache_full(const struct list_cache *repeats)
{
    return repeats->kept.count >= LIST_CACHE_MOST || repeats->size >= LIST_CACHE_SIZE;
}

static struct list_cache_text copy(struct list_cache *repeats, const char *text, size_t length)
{
    repeats->size += length;
    return (struct list_cache_text){arena_text(&repeats->arena, text, length), length};
}

static struct repeat *add(struct list_cache *repeats, const struct field *field,
                          struct field_list list)
{
    struct repeat *repeat = list_add(&repeats->kept, &repeats->arena);
    repeat->record = field->record;
    repeat->items.items = list.items;
    repeat->items.count = repeat->items.room = list.count;
    return repeat;
}

void list_cache_keep(struct list_cache *repeats, const struct field *field, const void *base,
                     const char *text, size_t length)
{
    add(repeats, field, field_list(field, base))->read = copy(repeats, text, length);
}

struct repeat *list_cache_of(struct list_cache *repeats, const struct record *record,
                             const struct field *field, const void *base)
{
    struct field_list list = field_list(field, base);
    for (size_t i = 0; i < repeats->kept.count; i++) {
        struct repeat *repeat = likeliest(repeats, i);
        if (repeat->items.items == list.items && repeat->items.count == list.count)
            return found(repeats, repeat);
    }
    if (!field_unchanged(record, field, base) || list_cache_full(repeats))
        return NULL;
    return add(repeats, field, list);
}

void list_cache_keep_written(struct list_cache *repeats, struct repeat *repeat, const char *text,
                             size_t length)
{
    if (repeats->size < LIST_CACHE_SIZE)
        repeat->written = copy(repeats, text, length);
}

void list_cache_free(struct list_cache *repeats)
{
    arena_free(&repeats->arena);
}
