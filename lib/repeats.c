#include "repeats.h"

#include <string.h>

const struct repeat *repeats_find(struct repeats *repeats, const struct record *record,
                                  const char *text, const char *end)
{
    for (size_t i = 0, at = repeats->next; i < repeats->kept.count; i++, at++) {
        at %= repeats->kept.count;
        const struct repeat *repeat = &repeats->kept.items[at];
        if (repeat->record == record && repeat->length <= (size_t)(end - text) &&
            memcmp(repeat->text, text, repeat->length) == 0) {
            repeats->next = at + 1;
            return repeat;
        }
    }
    return NULL;
}

bool repeats_full(const struct repeats *repeats)
{
    return repeats->kept.count >= REPEATS_MOST || repeats->size >= REPEATS_SIZE;
}

void repeats_keep(struct repeats *repeats, const struct field *field, const void *base,
                  const char *text, size_t length)
{
    struct field_list list = field_list(field, base);
    struct repeat *repeat = list_add(&repeats->kept, &repeats->arena);
    *repeat = (struct repeat){.record = field->record, .length = length};
    repeats->size += length;
    repeat->text = arena_text(&repeats->arena, text, length);
    repeat->items.items = list.items;
    repeat->items.count = repeat->items.room = list.count;
}

void repeats_free(struct repeats *repeats)
{
    arena_free(&repeats->arena);
}
