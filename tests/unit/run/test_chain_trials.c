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

/* D of the chain from the reference. */
static double energy(const struct tried_chain *chain)
{
    double sum[MATRIX] = {0};
    for (size_t block = 0; block < chain->blocks.blocks; block++)
        for (size_t i = 0; i < MATRIX; i++)
            sum[i] += chain->blocks.weight[block] * chain->blocks.distance[block * MATRIX + i];
    return energy_distance_of(&(struct energy_sample){sum, SEEDS, SEEDS});
}

static void every_scan_counts_in_its_scene_and_the_weights_sum_to_1(void **state)
{
    (void)state;
    struct bench bench;
    begin(&bench, "srr24-pair-every-frame");
    struct tried_chain reference = usual(&bench);
    assert_int_equal(chain_trials_begin(&bench.trials, &reference), 0);
    assert_int_equal(bench.trials.scans.count, 24); /* of two sensors */
    assert_int_equal(bench.trials.blocks, 12);
    double sum = 0, targets = 0;
    for (size_t i = 0; i < 12; i++)
        sum += bench.trials.block_weight[i];
    assert_close(sum, 1, 1e-12);
    for (size_t i = 0; i < 24; i++) {
        assert_close(bench.trials.scans.items[i].share, 0.5, 0);
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
    assert_int_equal(one.blocks.blocks, 12);
    assert_memory_equal(one.blocks.distance, other.blocks.distance, 12 * MATRIX * sizeof(double));
    for (size_t block = 0; block < 12; block++)
        for (size_t i = 0; i < ALL; i++)
            for (size_t j = 0; j < ALL; j++) {
                const double *distance = one.blocks.distance + block * MATRIX;
                assert_close(distance[i * ALL + j], distance[j * ALL + i], 0);
                assert_true(i != j || distance[i * ALL + j] == 0);
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
            double between = 0, within = 0;
            for (size_t block = 0; block < 12; block++) {
                between += same.blocks.distance[block * MATRIX + i * ALL + SEEDS + j];
                within += ideal.blocks.distance[block * MATRIX + (SEEDS + i) * ALL + SEEDS + j];
            }
            assert_true(between > 0);
            assert_close(within, 0, 0); /* ideal lists draw nothing */
        }
    assert_true(fabs(energy(&same)) < 0.1 * energy(&ideal));
    assert_true(ideal.targets_per_scan > same.targets_per_scan);
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
    chain_trials_divide(&sample);
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
        cmocka_unit_test(every_scan_counts_in_its_scene_and_the_weights_sum_to_1),
        cmocka_unit_test(distances_are_symmetric_and_the_same_in_every_run),
        cmocka_unit_test(other_seeds_make_other_lists_of_the_same_law),
        cmocka_unit_test(frames_without_a_scan_are_refused),
        cmocka_unit_test(a_stage_that_fails_names_itself_and_the_frame),
        cmocka_unit_test(all_frames_are_kept_while_they_are_few),
        cmocka_unit_test(of_many_frames_one_of_each_stretch_is_kept),
        cmocka_unit_test(a_sample_is_in_step_with_no_cycle),
        cmocka_unit_test(many_scenes_are_blocks),
        cmocka_unit_test(few_scenes_are_cut_into_stretches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
