#include "run_bench.h"

/* A sample of so many frames; scenes follow each other. */
static struct frame_sample sample_of(int frames, int scenes, int64_t most, struct arena *arena)
{
    struct frame_sample sample = {.arena = arena, .most = most};
    struct arena scratch = {0};
    for (int i = 0; i < frames; i++) {
        char name[32];
        snprintf(name, sizeof name, "scene %d", (int)((int64_t)i * scenes / frames));
        struct frame frame = {.scene = name, .frame = i, .interval_s = 1, .ego = "ego"};
        frame.arena = &scratch;
        frame.present = PART_OBJECTS;
        assert_done(frame_sample_add, &sample, &frame);
    }
    arena_free(&scratch);
    return sample;
}

TEST(all_frames_are_kept_while_they_are_few)
{
    struct frame_sample sample = sample_of(100, 1, 100, check_arena());
    assert_int_equal(sample.list.count, 100);
    for (size_t i = 0; i < 100; i++)
        assert_int_equal(sample.list.items[i].place, i);
}

TEST(exactly_as_many_frames_are_kept_as_are_asked_for)
{
    static const struct {
        int frames, most, kept;
    } cases[] = {{201, 64, 64}, {64, 64, 64}, {63, 64, 63}, {127, 64, 64},  {128, 64, 64},
                 {5000, 7, 7},  {9, 1, 1},    {1, 1, 1},    {300, 299, 299}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct frame_sample sample = sample_of(cases[i].frames, 1, cases[i].most, check_arena());
        frame_sample_thin(&sample, cases[i].most);
        assert_int_equal(sample.list.count, cases[i].kept);
        for (size_t k = 0; k < sample.list.count; k++) {
            int64_t apart = sample.list.items[k].place * cases[i].kept / cases[i].frames;
            assert_in_range(k + 2, apart, apart + 4); /* spread over the stream, in its order */
            assert_true(k == 0 || sample.list.items[k].place > sample.list.items[k - 1].place);
        }
    }
}

TEST(of_many_frames_one_of_each_stretch_is_kept)
{
    struct frame_sample sample = sample_of(6400, 1, 100, check_arena());
    assert_int_equal(sample.seen, 6400);
    assert_int_equal(sample.stride, 64);
    assert_int_equal(sample.list.count, 100);
    for (size_t i = 0; i < sample.list.count; i++)
        assert_int_equal(sample.list.items[i].place / 64, i);
}

/* A radar that measures in every second, third or eighth frame is met in all its phases. */
TEST(a_sample_is_in_step_with_no_cycle)
{
    struct frame_sample sample = sample_of(6400, 1, 100, check_arena());
    for (int cycle = 2; cycle <= 8; cycle++)
        for (int phase = 0; phase < cycle; phase++) {
            int met = 0;
            for (size_t i = 0; i < sample.list.count; i++)
                met += sample.list.items[i].place % cycle == phase;
            assert_in_range(met, 50 / cycle, 150 / cycle + 4);
        }
}
