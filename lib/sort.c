#include "sort.h"

#include <stdbool.h>
#include <string.h>

struct sorting {
    size_t size;
    int (*compare)(const void *, const void *);
};

static bool is_sorted(const struct sorting *sorting, const char *items, size_t count)
{
    for (size_t i = 1; i < count; i++)
        if (sorting->compare(items + (i - 1) * sorting->size, items + i * sorting->size) > 0)
            return false;
    return true;
}

/* Merges the sorted left and right halves of from into to. */
static void merge(const struct sorting *sorting, const char *from, size_t count, char *to)
{
    size_t size = sorting->size;
    const char *left = from, *middle = from + count / 2 * size, *right = middle,
               *end = from + count * size;
    for (; left < middle || right < end; to += size) {
        bool take_left = right == end || (left < middle && sorting->compare(left, right) <= 0);
        memcpy(to, take_left ? left : right, size);
        *(take_left ? &left : &right) += size;
    }
}

/* Sorts count items into to; from holds the same items and is used as scratch. */
static void sort_into(const struct sorting *sorting, char *from, size_t count, char *to)
{
    if (count < 2)
        return;
    size_t left = count / 2;
    sort_into(sorting, to, left, from);
    sort_into(sorting, to + left * sorting->size, count - left, from + left * sorting->size);
    merge(sorting, from, count, to);
}

void sort_items(void *items, size_t count, size_t size, int (*compare)(const void *, const void *),
                struct arena *arena)
{
    const struct sorting sorting = {size, compare};
    if (is_sorted(&sorting, items, count))
        return;
    char *scratch = arena_get(arena, count * size);
    memcpy(scratch, items, count * size);
    sort_into(&sorting, scratch, count, items);
}
