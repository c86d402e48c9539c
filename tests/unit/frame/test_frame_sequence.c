#include "check.h"

#include "frame/frame_sequence.h"

struct bench {
    struct arena *arena;
    struct diag diag;
    struct frame_sequence completeness;
    struct frame_place place; /* of the latest frame */
};

/* Frames stand one a line of "a.jsonl", and behind new_file in "b.jsonl". */
static struct frame_place next_place(struct bench *bench)
{
    bench->place.line++;
    return bench->place;
}

static void new_file(struct bench *bench)
{
    bench->place = (struct frame_place){"b.jsonl", 0};
}

static struct bench begin(void)
{
    return (struct bench){.arena = check_arena(), .place = {"a.jsonl", 0}};
}

static int follow(struct bench *bench, const char *scene, int64_t number, bool last)
{
    struct frame frame = {.scene = scene, .seed = 1, .frame = number, .last = last};
    return frame_sequence_follow(&bench->completeness, &frame, next_place(bench), bench->arena,
                                 &bench->diag);
}

typedef int check(struct frame_sequence *, const struct frame *, struct frame_place, struct arena *,
                  struct diag *);

static int add(struct bench *bench, check *add_to, uint64_t seed, int64_t number)
{
    struct frame frame = {.scene = "a", .seed = seed, .frame = number, .last = number == 2};
    return add_to(&bench->completeness, &frame, next_place(bench), bench->arena, &bench->diag);
}

TEST(nothing_at_all_is_not_complete)
{
    struct bench bench = begin();
    assert_int_equal(frame_sequence_end(&bench.completeness, &bench.diag), -1);
    assert_string_equal(bench.diag.text, "no frame at all; expected whole scenes");
}

TEST(scenes_may_interleave)
{
    struct bench bench = begin();
    for (int64_t number = 0; number < 3; number++) {
        assert_int_equal(follow(&bench, "a", number, number == 2), 0);
        assert_int_equal(follow(&bench, "b", number, number == 2), 0);
    }
    assert_int_equal(frame_sequence_end(&bench.completeness, &bench.diag), 0);
}

TEST(gaps_repetitions_and_what_comes_after_the_end_are_refused)
{
    static const struct {
        int64_t first, second;
        bool last;
        const char *message;
    } cases[] = {
        {1, 2, false, "frame: 1 of scene \"a\" with seed 1 is out of order; expected 0"},
        {0, 2, false, "frame: 2 of scene \"a\" with seed 1 is out of order; expected 1"},
        {0, 0, false,
         "frame: 0 of scene \"a\" with seed 1 comes behind frame 0; that scene began at a.jsonl:1"},
        {0, 1, true, "frame: 1 of scene \"a\" with seed 1 comes after its last one"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct bench bench = begin();
        if (follow(&bench, "a", cases[i].first, cases[i].last) == 0)
            assert_int_equal(follow(&bench, "a", cases[i].second, false), -1);
        assert_string_equal(bench.diag.text, cases[i].message);
        assert_int_equal(bench.diag.code, DIAG_DATA);
    }
}

TEST(a_scene_without_its_end_is_told)
{
    struct bench bench = begin();
    assert_int_equal(follow(&bench, "whole", 0, true), 0);
    assert_int_equal(follow(&bench, "cut", 0, false), 0);
    assert_int_equal(frame_sequence_end(&bench.completeness, &bench.diag), -1);
    assert_string_equal(bench.diag.text, "scene \"cut\" with seed 1 ends before its last frame");
}

TEST(two_seeds_of_a_name_are_two_scenes)
{
    check *const checks[] = {frame_sequence_follow, frame_sequence_ascend, frame_sequence_once};
    for (size_t i = 0; i < COUNT(checks); i++) {
        struct bench bench = begin();
        for (int64_t number = 0; number < 3; number++) {
            assert_int_equal(add(&bench, checks[i], 1, number), 0);
            assert_int_equal(frame_sequence_one_seed(&bench.completeness, &bench.diag),
                             number > 0 ? -1 : 0);
            assert_int_equal(add(&bench, checks[i], 2, number), 0);
        }
    }
}

TEST(a_stream_joined_with_itself_is_refused_with_both_places)
{
    static const struct {
        check *check;
        const char *message;
    } cases[] = {
        {frame_sequence_follow, "comes behind frame 2; that scene began at a.jsonl:1"},
        {frame_sequence_ascend, "comes behind frame 2; that scene began at a.jsonl:1"},
        {frame_sequence_once, "stands at a.jsonl:1 already"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct bench bench = begin();
        for (int64_t number = 0; number < 3; number++)
            assert_int_equal(add(&bench, cases[i].check, 7, number), 0);
        new_file(&bench);
        assert_int_equal(add(&bench, cases[i].check, 7, 0), -1);
        assert_non_null(strstr(bench.diag.text, "frame: 0 of scene \"a\" with seed 7 "));
        assert_non_null(strstr(bench.diag.text, cases[i].message));
    }
}

TEST(a_shuffled_stream_has_each_frame_once)
{
    static const int64_t order[] = {2, 0, 3, 1};
    struct bench bench = begin();
    for (size_t i = 0; i < 4; i++)
        assert_int_equal(add(&bench, frame_sequence_once, 1, order[i]), 0);
    assert_int_equal(add(&bench, frame_sequence_once, 1, 3), -1);
    assert_non_null(strstr(bench.diag.text, "stands at a.jsonl:3 already"));
}

TEST(each_of_many_scenes_is_remembered)
{
    enum { SCENES = 20000 };
    struct bench bench = begin();
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
}
