#include "text/list_cache.h"

/* The cached list to try next. The search begins behind the list found last, because frames repeat
 * their lists in the same order. */
static struct list_cache_entry *candidate(const struct list_cache *cache, size_t tries)
{
    return &cache->kept.items[(cache->next + tries) % cache->kept.count];
}

static struct list_cache_entry *note_found(struct list_cache *cache, struct list_cache_entry *list)
{
    cache->next = (size_t)(list - cache->kept.items) + 1;
    return list;
}

static bool begins_with(const char *text, const char *end, struct field_text beginning)
{
    return beginning.bytes != NULL && beginning.length <= (size_t)(end - text) &&
           memcmp(beginning.bytes, text, beginning.length) == 0;
}

const struct list_cache_entry *list_cache_find(struct list_cache *cache,
                                               const struct record *record, const char *text,
                                               const char *end)
{
    for (size_t i = 0; i < cache->kept.count; i++) {
        struct list_cache_entry *list = candidate(cache, i);
        if (list->record == record && begins_with(text, end, list->read))
            return note_found(cache, list);
    }
    return NULL;
}

bool list_cache_full(const struct list_cache *cache)
{
    return cache->kept.count >= LIST_CACHE_MOST || cache->size >= LIST_CACHE_SIZE;
}

static struct field_text copy(struct list_cache *cache, const char *text, size_t length)
{
    cache->size += length;
    return (struct field_text){arena_text(&cache->arena, text, length), length};
}

static struct list_cache_entry *add(struct list_cache *cache, const struct field *field,
                                    struct field_list member)
{
    struct list_cache_entry *list = list_add(&cache->kept, &cache->arena);
    list->record = field->record;
    list->items.items = member.items;
    list->items.count = list->items.room = member.count;
    return list;
}

void list_cache_keep(struct list_cache *cache, const struct field *field, const void *base,
                     const char *text, size_t length)
{
    add(cache, field, field_list(field, base))->read = copy(cache, text, length);
}

struct list_cache_entry *list_cache_of(struct list_cache *cache, const struct record *record,
                                       const struct field *field, const void *base)
{
    struct field_list member = field_list(field, base);
    for (size_t i = 0; i < cache->kept.count; i++) {
        struct list_cache_entry *list = candidate(cache, i);
        if (list->items.items == member.items && list->items.count == member.count)
            return note_found(cache, list);
    }
    if (!field_unchanged(record, field, base) || list_cache_full(cache))
        return NULL;
    return add(cache, field, member);
}

void list_cache_keep_written(struct list_cache *cache, struct list_cache_entry *list,
                             const char *text, size_t length)
{
    if (cache->size < LIST_CACHE_SIZE)
        list->written = copy(cache, text, length);
}
