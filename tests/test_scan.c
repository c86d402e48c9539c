#include "check.h"

#include "scan.h"

enum { RAYS = 1000, CELLS = 3 };

struct many {
    struct ray rays[RAYS];
    size_t cell[RAYS];
    struct arena arena;
    struct frame frame;
    struct scan scan;
};

static struct many many;

/* Cells take turns, strongest first. */
static int make_many(void **state)
{
    *state = &many;
    for (size_t i = 0; i < RAYS; i++) {
        many.rays[i] = (struct ray){.amplitude = (double)(RAYS - i)};
        many.cell[i] = i % CELLS;
    }
    many.frame.arena = &many.arena;
    many.scan = (struct scan){.reception = {.frame = &many.frame},
                              .resolved = {many.rays, many.cell, RAYS},
                              .cells = CELLS};
    return 0;
}

static int free_many(void **state)
{
    struct many *made = *state;
    arena_free(&made->arena);
    return 0;
}

static void members_are_a_cell_s_rays_in_their_order(void **state)
{
    struct many *made = *state;
    size_t count, all = 0;
    for (size_t number = 0; number < CELLS; number++) {
        const struct ray *members = scan_members(&made->scan, number, &count);
        for (size_t i = 0; i < count; i++)
            assert_true(members[i].amplitude == (double)(RAYS - number - CELLS * i));
        all += count;
    }
    assert_int_equal(all, RAYS);
}

/* Else a frame of many cells takes memory with their square. */
static void members_take_no_more_room_than_they_need(void **state)
{
    struct many *made = *state;
    const size_t enough = (RAYS + CELLS) * sizeof(struct ray);
    arena_get(&made->arena, 4 * enough);
    arena_clear(&made->arena);
    for (size_t number = 0, count; number < CELLS; number++)
        scan_members(&made->scan, number, &count);
    assert_in_range(made->arena.used, 1, enough);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(members_are_a_cell_s_rays_in_their_order, make_many,
                                        free_many),
        cmocka_unit_test_setup_teardown(members_take_no_more_room_than_they_need, make_many,
                                        free_many),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
