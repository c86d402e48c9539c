#include "base/sort.h"

#include "check.h"
#include "sample.h"

struct item {
    int key;
    int place;
    char padding[13];
};

static int compare(const void *left, const void *right)
{
    const struct item *a = left, *b = right;
    return (a->key > b->key) - (a->key < b->key);
}

static int compare_with_place(const void *left, const void *right)
{
    const struct item *a = left, *b = right;
    int order = compare(left, right);
    return order != 0 ? order : (a->place > b->place) - (a->place < b->place);
}

TEST(items_are_sorted_and_ties_stay_in_their_order)
{
    uint64_t sample = 1;
    for (int round = 0; round < 2000; round++) {
        size_t count = (size_t)sample_between(&sample, 0, 60);
        int keys = 1 + (int)sample_between(&sample, 0, 20);
        struct item items[60], expected[60];
        for (size_t i = 0; i < count; i++) {
            items[i] = (struct item){(int)sample_between(&sample, 0, keys), (int)i, "x"};
            expected[i] = items[i];
        }
        qsort(expected, count, sizeof *expected, compare_with_place);
        sort_items(items, count, sizeof *items, compare, check_arena());
        for (size_t i = 0; i < count; i++)
            assert_true(items[i].key == expected[i].key && items[i].place == expected[i].place);
        arena_clear(check_arena());
    }
}

TEST(a_sorted_list_takes_no_memory)
{
    struct arena arena = {0};
    struct item items[] = {{1, 0, ""}, {1, 1, ""}, {2, 2, ""}};
    sort_items(items, 3, sizeof *items, compare, &arena);
    sort_items(NULL, 0, sizeof *items, compare, &arena);
    assert_null(arena.blocks);
}
