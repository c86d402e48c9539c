#include "run_bench.h"

#include "run/ladder.h"
#include "score/energy_distance.h"

enum { SEEDS = LADDER_SEEDS, ALL = 2 * SEEDS, MATRIX = ALL * ALL };

struct bench {
    struct runner runner; /* of a tool */
    struct arena arena;
    struct frame_sample sample;
    struct ladder ladder;
};

static void begin(struct bench *bench, const char *suite)
{
    *bench = (struct bench){0};
    assert_int_equal(
        runner_prepare_tool(&bench->runner, fused_tool("plan"), 2, WORDS("--sensors", suite)), 0);
    bench->sample = sample_of_traffic("12", &bench->arena);
    bench->ladder = (struct ladder){
        .runner = &bench->runner, .sample = &bench->sample, .sensors = suite, .expected = 2};
}

static void end(struct bench *bench)
{
    runner_free(&bench->runner);
    arena_free(&bench->arena);
}

static struct ladder_chain chain_of(struct bench *bench, const char *effects, const char *sensor,
                                    const char *noise)
{
    struct ladder_chain chain = {.chain = effects, .effects = effects};
    *list_add(&chain.programs, &bench->arena) = sensor;
    *list_add(&chain.programs, &bench->arena) = noise;
    return chain;
}

static struct ladder_chain usual(struct bench *bench)
{
    return chain_of(bench, "auto", "glint-sensor", "glint-noise");
}

/* D of the chain from the reference. */
static double energy(const struct ladder_chain *chain)
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
    struct ladder_chain reference = usual(&bench);
    assert_int_equal(ladder_begin(&bench.ladder, &reference), 0);
    assert_int_equal(bench.ladder.scans.count, 24); /* of two sensors */
    assert_int_equal(bench.ladder.blocks, 12);
    double sum = 0, targets = 0;
    for (size_t i = 0; i < 12; i++)
        sum += bench.ladder.block_weight[i];
    assert_close(sum, 1, 1e-12);
    for (size_t i = 0; i < 24; i++) {
        assert_close(bench.ladder.scans.items[i].share, 0.5, 0);
        for (size_t seed = 0; seed < SEEDS; seed++)
            targets += (double)bench.ladder.reference[seed].scans.items[i].targets.count;
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
    struct ladder_chain reference = usual(&bench), one = usual(&bench), other = usual(&bench);
    assert_int_equal(ladder_begin(&bench.ladder, &reference), 0);
    assert_int_equal(ladder_climb(&bench.ladder, &one), 0);
    assert_int_equal(ladder_climb(&bench.ladder, &other), 0);
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
    struct ladder_chain reference = usual(&bench), same = usual(&bench);
    struct ladder_chain ideal =
        chain_of(&bench, "none", "glint-sensor-perfect", "glint-noise-none");
    assert_int_equal(ladder_begin(&bench.ladder, &reference), 0);
    assert_int_equal(ladder_climb(&bench.ladder, &same), 0);
    assert_int_equal(ladder_climb(&bench.ladder, &ideal), 0);
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
    struct ladder_chain reference = usual(&bench);
    assert_int_equal(ladder_begin(&bench.ladder, &reference), -1);
    assert_int_equal(bench.runner.diag.code, DIAG_DATA);
    assert_string_equal(bench.runner.diag.text, "no sensor of the suite measures in these frames");
    end(&bench);
}

static void a_stage_that_fails_names_itself_and_the_frame(void **state)
{
    (void)state;
    struct bench bench;
    begin(&bench, "srr24-pair-every-frame");
    struct ladder_chain reference = chain_of(&bench, "rian", "glint-sensor", "glint-noise");
    assert_int_equal(ladder_begin(&bench.ladder, &reference), -1);
    assert_non_null(strstr(bench.runner.diag.text, "glint-ideal: --effects: "));
    assert_memory_equal(bench.runner.diag.text, "scene \"random-dense/", 20);
    end(&bench);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_scan_counts_in_its_scene_and_the_weights_sum_to_1),
        cmocka_unit_test(distances_are_symmetric_and_the_same_in_every_run),
        cmocka_unit_test(other_seeds_make_other_lists_of_the_same_law),
        cmocka_unit_test(frames_without_a_scan_are_refused),
        cmocka_unit_test(a_stage_that_fails_names_itself_and_the_frame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
