#include "run_bench.h"

#include "run/cost.h"
#include "run/plan.h"

#define EVERY (EFFECT_BIT(EFFECT_COUNT) - 1)

struct bench {
    struct runner runner; /* of glint-plan */
    struct arena arena;
    struct cost cost;
};

static void begin(struct bench *bench, const char *suite, enum cost_reference reference)
{
    *bench = (struct bench){.cost = {.suite = suite, .reference = reference, .whole = "auto"}};
    bench->cost.runner = &bench->runner;
    assert_int_equal(
        runner_prepare_tool(&bench->runner, fused_tool("plan"), 2, WORDS("--sensors", suite)), 0);
}

static void end(struct bench *bench)
{
    runner_free(&bench->runner);
    arena_free(&bench->arena);
}

/* The ladder of 12 frames, which call for these effects. */
static void measure(struct bench *bench, uint64_t needed)
{
    begin(bench, "srr24-pair-every-frame", COST_ALL);
    assert_int_equal(cost_begin(&bench->cost, 0), 0);
    bench->cost.sample = sample_of_traffic("12", &bench->arena);
    bench->cost.allowed = EVERY;
    bench->cost.needed = needed;
    if (cost_measure(&bench->cost) != 0)
        fail_msg("%s", bench->runner.diag.text);
}

static void the_reference_is_the_signal_where_there_is_one(void **state)
{
    (void)state;
    static const struct {
        const char *suite, *no_signal;
        enum cost_reference asked, reference;
    } cases[] = {
        {"srr24-pair", "the suite has no waveform", COST_SIGNAL, COST_ALL},
        {"srr24-pair", "it was not asked for", COST_ALL, COST_ALL},
        {"lrr77-signal-small", NULL, COST_SIGNAL, COST_SIGNAL},
    };
    for (size_t i = 0; i < 3; i++) {
        struct bench bench;
        begin(&bench, cases[i].suite, cases[i].asked);
        assert_int_equal(cost_begin(&bench.cost, 0), 0);
        bool built = fused_stage("sensor-signal") != NULL;
        if (cases[i].no_signal != NULL)
            assert_string_equal(bench.cost.no_signal, cases[i].no_signal);
        else if (built)
            assert_null(bench.cost.no_signal);
        else
            print_message("left out: glint-sensor-signal is not built\n");
        if (built || cases[i].no_signal != NULL)
            assert_int_equal(bench.cost.reference, cases[i].reference);
        end(&bench);
    }
}

static void a_sample_has_250_frames_or_fewer_where_the_signal_is_long(void **state)
{
    (void)state;
    struct bench bench;
    begin(&bench, "srr24-pair", COST_SIGNAL);
    assert_int_equal(cost_begin(&bench.cost, 0), 0);
    assert_int_equal(bench.cost.sample.most, 250);
    assert_int_equal(cost_begin(&bench.cost, 7), 0);
    assert_int_equal(bench.cost.sample.most, 7);
    end(&bench);
    begin(&bench, "lrr77-signal-large", COST_SIGNAL);
    assert_int_equal(cost_begin(&bench.cost, 0), 0); /* of 1,048,576 samples a frame */
    assert_int_equal(bench.cost.sample.most, bench.cost.no_signal == NULL ? 30 : 250);
    end(&bench);
    begin(&bench, "nowhere", COST_SIGNAL);
    assert_int_equal(cost_begin(&bench.cost, 0), -1);
    end(&bench);
}

static void a_ladder_leaves_out_each_effect_that_the_frames_call_for(void **state)
{
    (void)state;
    static const char *const names[] = {
        "perfect", "paper", "auto", "auto, no merging", "auto, no angle_noise", "smear"};
    struct bench bench;
    measure(&bench, EFFECT_BIT(EFFECT_MERGING) | EFFECT_BIT(EFFECT_ANGLE_NOISE));
    const struct cost *cost = &bench.cost;
    assert_int_equal(cost->chains.count, 6);
    for (size_t i = 0; i < 6; i++) {
        const struct ladder_chain *chain = &cost->chains.items[i];
        assert_string_equal(chain->chain, names[i]);
        assert_int_equal(chain->present, LADDER_ENERGY | LADDER_ERROR);
        assert_int_equal(chain->automatic, strncmp(names[i], "auto", 4) == 0);
    }
    assert_close(cost->chains.items[0].error.value, 1, 1e-12);
    assert_string_equal(cost->chains.items[2].effects, "auto");
    assert_string_equal(cost->chains.items[3].effects, "auto,-merging");
    assert_int_equal(cost->chains.items[3].left_out, EFFECT_BIT(EFFECT_MERGING));
    assert_string_equal(cost->chains.items[5].programs.items[0], "glint-sensor-smear");
    assert_int_equal(cost->frames, 12);
    assert_int_equal(cost->seen_frames, 12);
    assert_int_equal(cost->scenes, 12);
    assert_close(cost_added(cost, &cost->chains.items[2]).value, 0, 1e-12);
    assert_close(cost_added(cost, &cost->chains.items[3]).value,
                 cost->chains.items[3].error.value - cost->chains.items[2].error.value, 1e-12);
    end(&bench);
}

/* Times and errors that no machine changes. */
static void set_chain(struct cost *cost, size_t at, double us, double error)
{
    cost->chains.items[at].us_per_frame = us;
    cost->chains.items[at].error = (struct relative_error){error, error, error};
}

static void the_cheapest_or_the_most_accurate_chain_within_the_bound_is_found(void **state)
{
    (void)state;
    struct bench bench;
    static const struct {
        enum cost_bound bound;
        double most;
        const char *found;
    } cases[] = {
        {COST_BOUND_ERROR, 0.3, "paper"}, {COST_BOUND_ERROR, 0.09, "auto"},
        {COST_BOUND_ERROR, 2, "paper"},   {COST_BOUND_US, 100, "auto"},
        {COST_BOUND_US, 12, "perfect"},   {COST_BOUND_US, 10, "paper"},
    };
    measure(&bench, 0);
    assert_int_equal(bench.cost.chains.count, 4);
    set_chain(&bench.cost, 0, 11, 0.2);
    set_chain(&bench.cost, 1, 10, 0.25);
    set_chain(&bench.cost, 2, 40, 0.01);
    set_chain(&bench.cost, 3, 90, 0.02);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct ladder_chain *found = cost_find(&bench.cost, cases[i].bound, cases[i].most);
        assert_non_null(found);
        assert_string_equal(found->chain, cases[i].found);
        assert_ptr_equal(bench.cost.chosen, found->chain);
    }
    assert_null(cost_find(&bench.cost, COST_BOUND_US, 9.99));
    assert_int_equal(bench.runner.diag.code, DIAG_DATA);
    assert_string_equal(bench.runner.diag.text,
                        "no chain holds the bound; the nearest, paper, takes 10.0 us a frame and "
                        "has an error of up to 25.0 %");
    end(&bench);
}

static void without_an_error_of_ideal_echoes_nothing_is_found(void **state)
{
    (void)state;
    struct bench bench;
    measure(&bench, 0);
    bench.cost.chains.items[0].present = LADDER_ENERGY;
    assert_null(cost_find(&bench.cost, COST_BOUND_ERROR, 1));
    assert_int_equal(bench.runner.diag.code, DIAG_DATA);
    assert_memory_equal(bench.runner.diag.text, "ideal echoes are not told from the reference", 44);
    end(&bench);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_reference_is_the_signal_where_there_is_one),
        cmocka_unit_test(a_sample_has_250_frames_or_fewer_where_the_signal_is_long),
        cmocka_unit_test(a_ladder_leaves_out_each_effect_that_the_frames_call_for),
        cmocka_unit_test(the_cheapest_or_the_most_accurate_chain_within_the_bound_is_found),
        cmocka_unit_test(without_an_error_of_ideal_echoes_nothing_is_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
