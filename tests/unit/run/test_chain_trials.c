#include "run_bench.h"

#include "run/chain_trials.h"
#include "run/trial_options.h"

enum { SEEDS = CHAIN_TRIALS_SEEDS, ALL = 2 * SEEDS, MATRIX = ALL * ALL };

struct bench {
    struct runner runner; /* of a tool */
    struct arena arena;
    struct frame_sample sample;
    struct trial_bench bench;
    struct chain_trials trials;
    struct tried_chain reference;
};

static int begin(void **state)
{
    const struct trial_options options = {.choice = {"srr24-pair-every-frame", NULL}};
    struct bench *bench = check_make(state, sizeof *bench);
    begin_tool(&bench->runner, options.choice.sensors);
    bench->sample = sample_of_traffic("12", &bench->arena);
    assert_int_equal(trial_begin(&bench->bench, &options, &bench->runner), 0);
    bench->trials = (struct chain_trials){.bench = &bench->bench, .sample = &bench->sample};
    return 0;
}

static int end(void **state)
{
    struct bench *bench = *state;
    trial_end(&bench->bench);
    arena_free(&bench->trials.kept);
    runner_free(&bench->runner);
    arena_free(&bench->arena);
    free(bench);
    return 0;
}

#define TRIALS_TEST(name) TEST_WITH(begin, end, struct bench *bench, name)

static void prepare(struct bench *bench, struct tried_chain *chain, const char *effects,
                    const char *sensor, const char *noise)
{
    *chain = (struct tried_chain){
        .trial = &chain->own,
        .own = {.effects = effects, .effect = EFFECT_NONE, .programs = {sensor, noise}},
        .row.chain = effects};
    trial_prepare(&bench->bench, chain->trial);
}

static int run_reference(struct bench *bench, const char *effects)
{
    prepare(bench, &bench->reference, effects, "glint-sensor", "glint-noise");
    return chain_trials_begin(&bench->trials, &bench->reference);
}

/* Runs one chain alone. */
static struct tried_chain *run(struct bench *bench, const char *effects, const char *sensor,
                               const char *noise)
{
    struct tried_chain *chain = arena_get(&bench->arena, sizeof *chain);
    struct tried_chains chains = {0};
    prepare(bench, chain, effects, sensor, noise);
    *list_add(&chains.list, &bench->arena) = chain;
    assert_int_equal(chain_trials_run(&bench->trials, &chains, TRIAL_ALONE), 0);
    return chain;
}

TRIALS_TEST(every_scan_counts_in_its_scene_and_the_shares_sum_to_1)
{
    assert_int_equal(run_reference(bench, "auto"), 0);
    assert_int_equal(bench->trials.scans.count, 24); /* of two sensors */
    assert_int_equal(bench->trials.scenes, 12);
    double targets = 0;
    for (size_t i = 0; i < 24; i++) {
        assert_close(bench->trials.scans.items[i].share, 1.0 / 24, 1e-15);
        for (size_t seed = 0; seed < SEEDS; seed++)
            targets += (double)bench->trials.reference[seed].scans.items[i].targets.count;
    }
    assert_true(targets > 0);
    assert_close(bench->reference.row.targets_per_scan, targets / (24 * SEEDS), 1e-12);
}

TRIALS_TEST(distances_are_symmetric_and_the_same_in_every_run)
{
    assert_int_equal(run_reference(bench, "auto"), 0);
    const struct tried_chain *one = run(bench, "auto", "glint-sensor", "glint-noise");
    const struct tried_chain *other = run(bench, "auto", "glint-sensor", "glint-noise");
    const double *distance = one->lists.distance;
    assert_memory_equal(distance, other->lists.distance, MATRIX * sizeof *distance);
    for (size_t i = 0; i < ALL; i++)
        for (size_t j = 0; j < ALL; j++) {
            assert_close(distance[i * ALL + j], distance[j * ALL + i], 0);
            assert_int_equal(distance[i * ALL + j] == 0, i == j);
        }
}

/* The reference has seeds of its own: its own chain has other lists, of the same law. */
TRIALS_TEST(other_seeds_make_other_lists_of_the_same_law)
{
    assert_int_equal(run_reference(bench, "auto"), 0);
    const struct tried_chain *same = run(bench, "auto", "glint-sensor", "glint-noise");
    const struct tried_chain *ideal =
        run(bench, "none", "glint-sensor-perfect", "glint-noise-none");
    for (size_t i = 0; i < SEEDS; i++)
        for (size_t j = 0; j < SEEDS; j++) {
            assert_true(same->lists.distance[i * ALL + SEEDS + j] > 0);
            /* ideal lists draw nothing */
            assert_close(ideal->lists.distance[(SEEDS + i) * ALL + SEEDS + j], 0, 0);
        }
    double far = energy_distance_of(&ideal->lists);
    assert_true(fabs(energy_distance_of(&same->lists)) < 0.1 * far);
    assert_true(ideal->row.targets_per_scan > same->row.targets_per_scan);
}

/* Lists that lose all their targets are farther off than those that lose a half, and the sum over
 * the reference's own lists is near 0. */
TRIALS_TEST(spoiled_lists_are_the_farther_off_the_more_is_lost)
{
    assert_int_equal(run_reference(bench, "auto"), 0);
    double none = chain_trials_spoiled(&bench->trials, 0, 0);
    double some = chain_trials_spoiled(&bench->trials, 0.3, 0);
    double half = chain_trials_spoiled(&bench->trials, 0.5, 0);
    double all = chain_trials_spoiled(&bench->trials, 1, 0);
    assert_true(fabs(none) < 0.2 * some);
    assert_true(some < 0.6 * half && half < 0.5 * all);
    assert_true(chain_trials_spoiled(&bench->trials, 0, 1) > 5 * fabs(none));
}

/* Beside the whole chain and from its home on, a chain has the lists that it has alone. */
TRIALS_TEST(a_chain_has_the_same_lists_beside_another_one)
{
    struct tried_chains chains = {0};
    assert_int_equal(run_reference(bench, "auto"), 0);
    const struct tried_chain *alone = run(bench, "auto,-merging", "glint-sensor", "glint-noise");
    const struct tried_chain *all = run(bench, "auto", "glint-sensor", "glint-noise");
    struct tried_chain whole = {.trial = &bench->bench.whole[TRIAL_IDEAL]};
    struct tried_chain without = {.trial = &bench->bench.without[EFFECT_MERGING]};
    *list_add(&chains.list, &bench->arena) = &whole;
    *list_add(&chains.list, &bench->arena) = &without;
    assert_int_equal(
        chain_trials_run(&bench->trials, &chains, TRIAL_TIMED | TRIAL_COMPARED | TRIAL_EFFECTS), 0);
    for (size_t i = 0; i < MATRIX; i++) {
        assert_close(without.lists.distance[i], alone->lists.distance[i], 1e-12);
        assert_close(whole.lists.distance[i], all->lists.distance[i], 1e-12);
    }
    assert_true(without.trial->changed > 0);
    assert_int_equal(whole.trial->changed, 0);
    assert_true(trial_time_of(&bench->bench, whole.trial).least_us > 0);
}

TRIALS_TEST(frames_without_a_scan_are_refused)
{
    bench->sample.list.count = 0;
    assert_int_equal(run_reference(bench, "auto"), -1);
    assert_int_equal(bench->runner.diag.code, DIAG_DATA);
    assert_string_equal(bench->runner.diag.text, "no sensor of the suite measures in these frames");
}

TRIALS_TEST(a_stage_that_fails_names_itself_and_the_frame)
{
    assert_int_equal(run_reference(bench, "rian"), -1);
    assert_non_null(strstr(bench->runner.diag.text, "glint-ideal: --effects: "));
    assert_memory_equal(bench->runner.diag.text, "scene \"random-dense/", 20);
}
