#include "repeats.h"

#include <string.h>

/* Frames ask in the same order for the same lists, by text and by address alike. */
static struct repeat *likeliest(const struct repeats *repeats, size_t tries)
{
    return &repeats->kept.items[(repeats->next + tries) % repeats->kept.count];
}

static struct repeat *found(struct repeats *repeats, struct repeat *repeat)
{
    repeats->next = (size_t)(repeat - repeats->kept.items) + 1;
    return repeat;
}

static bool begins_with(const char *text, const char *end, struct repeats_text beginning)
{
    return beginning.bytes != NULL && beginning.length <= (size_t)(end - text) &&
           memcmp(beginning.bytes, text, beginning.length) == 0;
}

const struct repeat *repeats_find(struct repeats *repeats, const struct record *record,
                                  const char *text, const char *end)
{
    for (size_t i = 0; i < repeats->kept.count; i++) {
        struct repeat *repeat = likeliest(repeats, i);
        if (repeat->record == record && begins_with(text, end, repeat->read))
            return found(repeats, repeat);
    }
    return NULL;
}

bool repeats_full(const struct repeats *repeats)
{
    return repeats->kept.count >= REPEATS_MOST || repeats->size >= REPEATS_SIZE;
}

static struct repeats_text copy(struct repeats *repeats, const char *text, size_t length)
{
    repeats->size += length;
    return (struct repeats_text){arena_text(&repeats->arena, text, length), length};
}

static struct repeat *add(struct repeats *repeats, const struct field *field,
                          struct field_list list)
{
    struct repeat *repeat = list_add(&repeats->kept, &repeats->arena);
    repeat->record = field->record;
    repeat->items.items = list.items;
    repeat->items.count = repeat->items.room = list.count;
    return repeat;
}

void repeats_keep(struct repeats *repeats, const struct field *field, const void *base,
                  const char *text, size_t length)
{
    add(repeats, field, field_list(field, base))->read = copy(repeats, text, length);
}

struct repeat *repeats_of(struct repeats *repeats, const struct record *record,
                          const struct field *field, const void *base)
{
    struct field_list list = field_list(field, base);
    for (size_t i = 0; i < repeats->kept.count; i++) {
        struct repeat *repeat = likeliest(repeats, i);
        if (repeat->items.items == list.items && repeat->items.count == list.count &&
            repeat->record == field->record)
            return found(repeats, repeat);
    }
    if (!field_as_read(record, field, base) || repeats_full(repeats))
        return NULL;
    return add(repeats, field, list);
}

void repeats_keep_written(struct repeats *repeats, struct repeat *repeat, const char *text,
                          size_t length)
{
    if (repeats->size < REPEATS_SIZE)
        repeat->written = copy(repeats, text, length);
}

void repeats_free(struct repeats *repeats)
{
    arena_free(&repeats->arena);
}
