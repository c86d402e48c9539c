#include "check.h"

#include <stdio.h>
#include <string.h>

#include "frame/frame_sequence.h"

struct bench {
    struct arena arena;
    struct diag diag;
    struct frame_sequence completeness;
};

static int follow(struct bench *bench, const char *scene, int64_t number, bool last)
{
    struct frame frame = {.scene = scene, .frame = number, .last = last};
    return frame_sequence_follow(&bench->completeness, &frame, &bench->arena, &bench->diag);
}

static void nothing_at_all_is_not_complete(void **state)
{
    (void)state;
    struct bench bench = {0};
    assert_int_equal(frame_sequence_end(&bench.completeness, &bench.diag), -1);
    assert_string_equal(bench.diag.text, "no frame at all; expected whole scenes");
}

static void scenes_may_interleave(void **state)
{
    (void)state;
    struct bench bench = {0};
    for (int64_t number = 0; number < 3; number++) {
        assert_int_equal(follow(&bench, "a", number, number == 2), 0);
        assert_int_equal(follow(&bench, "b", number, number == 2), 0);
    }
    assert_int_equal(frame_sequence_end(&bench.completeness, &bench.diag), 0);
    arena_free(&bench.arena);
}

static void gaps_repetitions_and_what_comes_after_the_end_are_refused(void **state)
{
    (void)state;
    static const struct {
        int64_t first, second;
        bool last;
        const char *message;
    } cases[] = {
        {1, 2, false, "frame: 1 of scene \"a\" is out of order"},
        {0, 2, false, "frame: 2 of scene \"a\" is out of order"},
        {0, 0, false, "frame: 0 of scene \"a\" is out of order"},
        {0, 1, true, "frame: 1 of scene \"a\" comes after its last one"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct bench bench = {0};
        if (follow(&bench, "a", cases[i].first, cases[i].last) == 0)
            assert_int_equal(follow(&bench, "a", cases[i].second, false), -1);
        assert_string_equal(bench.diag.text, cases[i].message);
        assert_int_equal(bench.diag.code, DIAG_DATA);
        arena_free(&bench.arena);
    }
}

static void a_scene_without_its_end_is_told(void **state)
{
    (void)state;
    struct bench bench = {0};
    assert_int_equal(follow(&bench, "whole", 0, true), 0);
    assert_int_equal(follow(&bench, "cut", 0, false), 0);
    assert_int_equal(frame_sequence_end(&bench.completeness, &bench.diag), -1);
    assert_string_equal(bench.diag.text, "scene \"cut\" ends before its last frame");
    arena_free(&bench.arena);
}

static void each_of_many_scenes_is_remembered(void **state)
{
    (void)state;
    enum { SCENES = 20000 };
    struct bench bench = {0};
    char name[32];
    for (int i = 0; i < SCENES; i++) {
        snprintf(name, sizeof name, "scene-%d", i);
        assert_int_equal(follow(&bench, name, 0, true), 0);
    }
    assert_int_equal(frame_sequence_end(&bench.completeness, &bench.diag), 0);
    for (int i = 0; i < SCENES; i++) {
        snprintf(name, sizeof name, "scene-%d", i);
        bench.diag = (struct diag){0};
        assert_int_equal(follow(&bench, name, 1, true), -1);
    }
    arena_free(&bench.arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_at_all_is_not_complete),
        cmocka_unit_test(scenes_may_interleave),
        cmocka_unit_test(gaps_repetitions_and_what_comes_after_the_end_are_refused),
        cmocka_unit_test(a_scene_without_its_end_is_told),
        cmocka_unit_test(each_of_many_scenes_is_remembered),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
