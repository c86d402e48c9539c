#include "run_bench.h"

#include <stdio.h>

#include "run/chain_trials.h"
#include "score/energy_distance.h"

enum { SEEDS = CHAIN_TRIALS_SEEDS, ALL = 2 * SEEDS, MATRIX = ALL * ALL };

struct bench {
    struct runner runner; /* of a tool */
    struct arena arena;
    struct frame_sample sample;
    struct chain_trials trials;
};

static void begin(struct bench *bench, const char *suite)
{
    *bench = (struct bench){0};
    assert_int_equal(
        runner_prepare(&bench->runner, stage_by_name("plan"), 2, WORDS("--sensors", suite)), 0);
    bench->sample = sample_of_traffic("12", &bench->arena);
    bench->trials = (struct chain_trials){
        .runner = &bench->runner, .sample = &bench->sample, .sensors = suite, .expected = 2};
}

static void end(struct bench *bench)
{
    runner_free(&bench->runner);
    arena_free(&bench->arena);
}

static struct tried_chain chain_of(struct bench *bench, const char *effects, const char *sensor,
                                   const char *noise)
{
    struct tried_chain chain = {.chain = effects, .effects = effects};
    *list_add(&chain.programs, &bench->arena) = sensor;
    *list_add(&chain.programs, &bench->arena) = noise;
    return chain;
}

static struct tried_chain usual(struct bench *bench)
{
    return chain_of(bench, "auto", "glint-sensor", "glint-noise");
}

static void every_scan_counts_in_its_scene_and_the_shares_sum_to_1(void **state)
{
    (void)state;
    struct bench bench;
    begin(&bench, "srr24-pair-every-frame");
    struct tried_chain reference = usual(&bench);
    assert_int_equal(chain_trials_begin(&bench.trials, &reference), 0);
    assert_int_equal(bench.trials.scans.count, 24); /* of two sensors */
    assert_int_equal(bench.trials.scenes, 12);
    double targets = 0;
    for (size_t i = 0; i < 24; i++) {
        assert_close(bench.trials.scans.items[i].share, 1.0 / 24, 1e-15);
        for (size_t seed = 0; seed < SEEDS; seed++)
            targets += (double)bench.trials.reference[seed].scans.items[i].targets.count;
    }
    assert_true(targets > 0);
    assert_close(reference.targets_per_scan, targets / (24 * SEEDS), 1e-12);
    assert_int_equal(reference.present, 0);
    end(&bench);
}

static void distances_are_symmetric_and_the_same_in_every_run(void **state)
{
    (void)state;
    struct bench bench;
    begin(&bench, "srr24-pair-every-frame");
    struct tried_chain reference = usual(&bench), one = usual(&bench), other = usual(&bench);
    assert_int_equal(chain_trials_begin(&bench.trials, &reference), 0);
    assert_int_equal(chain_trials_run(&bench.trials, &one), 0);
    assert_int_equal(chain_trials_run(&bench.trials, &other), 0);
    const double *distance = one.lists.distance;
    assert_memory_equal(distance, other.lists.distance, MATRIX * sizeof *distance);
    for (size_t i = 0; i < ALL; i++)
        for (size_t j = 0; j < ALL; j++) {
            assert_close(distance[i * ALL + j], distance[j * ALL + i], 0);
            assert_int_equal(distance[i * ALL + j] == 0, i == j);
        }
    end(&bench);
}

/* The reference has seeds of its own: its own chain has other lists, of the same law. */
static void other_seeds_make_other_lists_of_the_same_law(void **state)
{
    (void)state;
    struct bench bench;
    begin(&bench, "srr24-pair-every-frame");
    struct tried_chain reference = usual(&bench), same = usual(&bench);
    struct tried_chain ideal = chain_of(&bench, "none", "glint-sensor-perfect", "glint-noise-none");
    assert_int_equal(chain_trials_begin(&bench.trials, &reference), 0);
    assert_int_equal(chain_trials_run(&bench.trials, &same), 0);
    assert_int_equal(chain_trials_run(&bench.trials, &ideal), 0);
    for (size_t i = 0; i < SEEDS; i++)
        for (size_t j = 0; j < SEEDS; j++) {
            assert_true(same.lists.distance[i * ALL + SEEDS + j] > 0);
            /* ideal lists draw nothing */
            assert_close(ideal.lists.distance[(SEEDS + i) * ALL + SEEDS + j], 0, 0);
        }
    double far = energy_distance_of(&ideal.lists);
    assert_true(fabs(energy_distance_of(&same.lists)) < 0.1 * far);
    assert_true(ideal.targets_per_scan > same.targets_per_scan);
    end(&bench);
}

/* Lists that lose all their targets are farther off than those that lose a half, and the sum over
 * the reference's own lists is near 0. */
static void spoiled_lists_are_the_farther_off_the_more_is_lost(void **state)
{
    (void)state;
    struct bench bench;
    begin(&bench, "srr24-pair-every-frame");
    struct tried_chain reference = usual(&bench);
    assert_int_equal(chain_trials_begin(&bench.trials, &reference), 0);
    double none = chain_trials_spoiled(&bench.trials, 0, 0);
    double some = chain_trials_spoiled(&bench.trials, 0.3, 0);
    double half = chain_trials_spoiled(&bench.trials, 0.5, 0);
    double all = chain_trials_spoiled(&bench.trials, 1, 0);
    assert_true(fabs(none) < 0.2 * some);
    assert_true(some < 0.6 * half && half < 0.5 * all);
    assert_true(chain_trials_spoiled(&bench.trials, 0, 1) > 5 * fabs(none));
    end(&bench);
}

/* Beside a chain that simulates more, a chain saves time; its lists are those that it has alone. */
static void a_chain_has_the_same_lists_beside_another_one(void **state)
{
    (void)state;
    struct bench bench;
    begin(&bench, "srr24-pair-every-frame");
    struct tried_chain reference = usual(&bench), alone = usual(&bench), beside = usual(&bench);
    struct tried_chain other = chain_of(&bench, "none", "glint-sensor-perfect", "glint-noise-none");
    beside.beside = &other;
    assert_int_equal(chain_trials_begin(&bench.trials, &reference), 0);
    assert_int_equal(chain_trials_run(&bench.trials, &alone), 0);
    assert_int_equal(chain_trials_run(&bench.trials, &beside), 0);
    assert_memory_equal(alone.lists.distance, beside.lists.distance, MATRIX * sizeof(double));
    assert_close(alone.saved, 0, 0);
    assert_true(beside.saved_least <= beside.saved && beside.saved != 0);
    end(&bench);
}

static void frames_without_a_scan_are_refused(void **state)
{
    (void)state;
    struct bench bench;
    begin(&bench, "srr24-pair-every-frame");
    bench.sample.list.count = 0;
    struct tried_chain reference = usual(&bench);
    assert_int_equal(chain_trials_begin(&bench.trials, &reference), -1);
    assert_int_equal(bench.runner.diag.code, DIAG_DATA);
    assert_string_equal(bench.runner.diag.text, "no sensor of the suite measures in these frames");
    end(&bench);
}

static void a_stage_that_fails_names_itself_and_the_frame(void **state)
{
    (void)state;
    struct bench bench;
    begin(&bench, "srr24-pair-every-frame");
    struct tried_chain reference = chain_of(&bench, "rian", "glint-sensor", "glint-noise");
    assert_int_equal(chain_trials_begin(&bench.trials, &reference), -1);
    assert_non_null(strstr(bench.runner.diag.text, "glint-ideal: --effects: "));
    assert_memory_equal(bench.runner.diag.text, "scene \"random-dense/", 20);
    end(&bench);
}

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
        assert_int_equal(chain_trials_sample(&sample, &frame, &diag), 0);
    }
    arena_free(&scratch);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_scan_counts_in_its_scene_and_the_shares_sum_to_1),
        cmocka_unit_test(distances_are_symmetric_and_the_same_in_every_run),
        cmocka_unit_test(other_seeds_make_other_lists_of_the_same_law),
        cmocka_unit_test(spoiled_lists_are_the_farther_off_the_more_is_lost),
        cmocka_unit_test(a_chain_has_the_same_lists_beside_another_one),
        cmocka_unit_test(frames_without_a_scan_are_refused),
        cmocka_unit_test(a_stage_that_fails_names_itself_and_the_frame),
        cmocka_unit_test(all_frames_are_kept_while_they_are_few),
        cmocka_unit_test(of_many_frames_one_of_each_stretch_is_kept),
        cmocka_unit_test(a_sample_is_in_step_with_no_cycle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
