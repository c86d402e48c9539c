#include "base/sort.h"

#include <stdbool.h>

/* At most so many items are inserted one by one. */
enum { FEW = 12 };

/* The addresses of the items in the order reached so far, and where each run in order ends. */
struct sorting {
    int (*compare)(const void *, const void *);
    const char **from, **to;
    size_t *end;
    size_t runs;
};

static void find_runs(struct sorting *sorting, const char *items, size_t count, size_t size)
{
    for (size_t i = 0; i < count; i++) {
        sorting->from[i] = items + i * size;
        if (i > 0 && sorting->compare(sorting->from[i - 1], sorting->from[i]) > 0)
            sorting->end[sorting->runs++] = i;
    }
    sorting->end[sorting->runs++] = count;
}

/* Merges two neighbouring runs into one. */
static void merge(const struct sorting *sorting, size_t begin, size_t middle, size_t end)
{
    const char **left = sorting->from + begin, **right = sorting->from + middle;
    const char **to = sorting->to + begin;
    const char *const *left_end = right, *const *right_end = sorting->from + end;
    while (left < left_end && right < right_end)
        *to++ = sorting->compare(*left, *right) <= 0 ? *left++ : *right++;
    while (left < left_end)
        *to++ = *left++;
    while (right < right_end)
        *to++ = *right++;
}

static void merge_neighbours(struct sorting *sorting)
{
    size_t begin = 0, merged = 0;
    for (size_t run = 0; run < sorting->runs; run += 2) {
        size_t middle = sorting->end[run];
        size_t end = run + 1 < sorting->runs ? sorting->end[run + 1] : middle;
        merge(sorting, begin, middle, end);
        sorting->end[merged++] = end;
        begin = end;
    }
    sorting->runs = merged;
    const char **merged_at = sorting->to;
    sorting->to = sorting->from;
    sorting->from = merged_at;
}

static bool is_sorted(const char *items, size_t count, size_t size,
                      int (*compare)(const void *, const void *))
{
    for (size_t i = 1; i < count; i++)
        if (compare(items + (i - 1) * size, items + i * size) > 0)
            return false;
    return true;
}

/* Moves each item to its place, along the cycles of the permutation, so that each moves once. On
 * entry from[i] is the address of the item that belongs at place i; on return it is that of place
 * i. */
static void move_items(char *items, size_t count, size_t size, const char **from,
                       struct arena *arena)
{
    char *first = arena_room(arena, size);
    for (size_t i = 0; i < count; i++) {
        char *place = items + i * size;
        if (from[i] == place)
            continue;
        memcpy(first, place, size);
        size_t to = i;
        while (from[to] != place) {
            const char *next = from[to];
            from[to] = memcpy(items + to * size, next, size);
            to = (size_t)(next - items) / size;
        }
        from[to] = memcpy(items + to * size, first, size);
    }
}

/* Sets from to the addresses of few items in order. */
static void insert_each(const char **from, const char *items, size_t count, size_t size,
                        int (*compare)(const void *, const void *))
{
    for (size_t i = 0; i < count; i++) {
        const char *item = items + i * size;
        size_t at = i;
        for (; at > 0 && compare(from[at - 1], item) > 0; at--)
            from[at] = from[at - 1];
        from[at] = item;
    }
}

void sort_items(void *items, size_t count, size_t size, int (*compare)(const void *, const void *),
                struct arena *arena)
{
    if (is_sorted(items, count, size, compare))
        return;
    if (count <= FEW) {
        const char *from[FEW];
        insert_each(from, items, count, size, compare);
        move_items(items, count, size, from, arena);
        return;
    }
    struct sorting sorting = {
        .compare = compare,
        .from = arena_room(arena, count * sizeof(const char *)),
        .to = arena_room(arena, count * sizeof(const char *)),
        .end = arena_room(arena, count * sizeof(size_t)),
    };
    find_runs(&sorting, items, count, size);
    while (sorting.runs > 1)
        merge_neighbours(&sorting);
    move_items(items, count, size, sorting.from, arena);
}

static int ascending(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

void sort_numbers(double *numbers, size_t count, struct arena *arena)
{
    sort_items(numbers, count, sizeof *numbers, ascending, arena);
}
