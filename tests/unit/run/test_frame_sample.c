#include "check.h"

#include <stdio.h>

#include "run/frame_sample.h"

/* A sample of so many frames; scenes follow each other. */
static struct frame_sample sample_of(int frames, int scenes, int64_t most, struct arena *arena)
{
    struct frame_sample sample = {.arena = arena, .most = most};
    struct arena scratch = {0};
    for (int i = 0; i < frames; i++) {
        char name[16];
        snprintf(name, sizeof name, "scene %d", (int)((int64_t)i * scenes / frames));
        struct frame frame = {.scene = name, .frame = i, .interval_s = 1, .ego = "ego"};
        struct diag diag = {0};
        frame.arena = &scratch;
        frame.present = SECTION_OBJECTS;
        assert_int_equal(frame_sample_add(&sample, &frame, &diag), 0);
    }
    arena_free(&scratch);
    frame_sample_divide(&sample);
    return sample;
}

static void all_frames_are_kept_while_they_are_few(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct frame_sample sample = sample_of(100, 1, 100, &arena);
    assert_int_equal(sample.list.count, 100);
    for (size_t i = 0; i < 100; i++)
        assert_int_equal(sample.list.items[i].place, i);
    arena_free(&arena);
}

static void of_many_frames_one_of_each_stretch_is_kept(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct frame_sample sample = sample_of(6400, 1, 100, &arena);
    assert_int_equal(sample.seen, 6400);
    assert_int_equal(sample.stride, 64);
    assert_int_equal(sample.list.count, 100);
    for (size_t i = 0; i < sample.list.count; i++)
        assert_int_equal(sample.list.items[i].place / 64, i);
    arena_free(&arena);
}

/* A radar that measures in every second, third or eighth frame is met in all its phases. */
static void a_sample_is_in_step_with_no_cycle(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct frame_sample sample = sample_of(6400, 1, 100, &arena);
    for (int cycle = 2; cycle <= 8; cycle++)
        for (int phase = 0; phase < cycle; phase++) {
            int met = 0;
            for (size_t i = 0; i < sample.list.count; i++)
                met += sample.list.items[i].place % cycle == phase;
            assert_in_range(met, 50 / cycle, 150 / cycle + 4);
        }
    arena_free(&arena);
}

static void many_scenes_are_blocks(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct frame_sample sample = sample_of(60, 12, 100, &arena);
    assert_int_equal(sample.blocks, 12);
    for (size_t i = 0; i < 60; i++)
        assert_int_equal(sample.list.items[i].block, i / 5);
    arena_free(&arena);
}

static void few_scenes_are_cut_into_stretches(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct frame_sample one = sample_of(50, 1, 100, &arena);
    struct frame_sample three = sample_of(60, 3, 100, &arena);
    struct frame_sample short_one = sample_of(4, 1, 100, &arena);
    assert_int_equal(one.blocks, 10);
    assert_int_equal(three.blocks, 12);
    assert_int_equal(short_one.blocks, 4);
    assert_int_equal(sample_of(62, 1, 100, &arena).blocks, 11);
    for (size_t i = 0; i < 50; i++)
        assert_int_equal(one.list.items[i].block, i / 5);
    for (size_t i = 0; i < 60; i++)
        assert_int_equal(three.list.items[i].block, i / 5);
    arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_frames_are_kept_while_they_are_few),
        cmocka_unit_test(of_many_frames_one_of_each_stretch_is_kept),
        cmocka_unit_test(a_sample_is_in_step_with_no_cycle),
        cmocka_unit_test(many_scenes_are_blocks),
        cmocka_unit_test(few_scenes_are_cut_into_stretches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
