#include "run_bench.h"

#include "run/cost.h"
#include "run/plan.h"

#define EVERY (EFFECT_BIT(EFFECT_COUNT) - 1)

struct bench {
    struct runner runner; /* of a tool */
    struct arena arena;
    struct cost cost;
};

static void begin(struct bench *bench, const char *suite, enum cost_reference reference)
{
    *bench = (struct bench){.cost = {.suite = suite, .reference = reference, .whole = "auto"}};
    bench->cost.runner = &bench->runner;
    assert_int_equal(
        runner_prepare(&bench->runner, stage_by_name("plan"), 2, WORDS("--sensors", suite)), 0);
}

static void end(struct bench *bench)
{
    runner_free(&bench->runner);
    arena_free(&bench->arena);
}

/* The chains on 12 frames, which call for these effects. */
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
        bool built = stage_by_name("sensor-signal") != NULL;
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

static void chains_leave_out_each_effect_that_the_frames_call_for(void **state)
{
    (void)state;
    static const char *const names[] = {
        "perfect", "paper", "auto", "auto, no merging", "auto, no angle_noise", "smear"};
    struct bench bench;
    measure(&bench, EFFECT_BIT(EFFECT_MERGING) | EFFECT_BIT(EFFECT_ANGLE_NOISE));
    const struct cost *cost = &bench.cost;
    assert_int_equal(cost->chains.count, 6);
    for (size_t i = 0; i < 6; i++) {
        const struct tried_chain *chain = &cost->chains.items[i];
        assert_string_equal(chain->chain, names[i]);
        assert_int_equal(chain->present, CHAIN_TRIALS_ENERGY | CHAIN_TRIALS_ERROR);
        assert_int_equal(chain->automatic, strncmp(names[i], "auto", 4) == 0);
    }
    assert_close(cost->chains.items[0].relative_distance.value, 1, 1e-12);
    assert_string_equal(cost->chains.items[2].effects, "auto");
    assert_string_equal(cost->chains.items[3].effects, "auto,-merging");
    assert_int_equal(cost->chains.items[3].left_out, EFFECT_BIT(EFFECT_MERGING));
    assert_string_equal(cost->chains.items[5].programs.items[0], "glint-sensor-smear");
    assert_int_equal(cost->frames, 12);
    assert_int_equal(cost->seen_frames, 12);
    assert_int_equal(cost->scenes, 12);
    assert_close(cost_added(cost, &cost->chains.items[2]).value, 0, 1e-12);
    double energy = cost->chains.items[3].energy.value - cost->chains.items[2].energy.value;
    assert_close(cost_added(cost, &cost->chains.items[3]).value,
                 energy / cost->chains.items[0].energy.value, 1e-12);
    assert_true(cost->scale.lost_30_percent > 0.05 && cost->scale.one_cell_off > 0.05);
    assert_true(cost->scale.lost_half > 1.2 * cost->scale.lost_30_percent);
    assert_true(cost->scale.lost_half < 1);
    end(&bench);
}

/* What Buehren and Yang's model has: the list of a radar is limited in it, too. */
static void the_chain_of_the_paper_has_the_papers_effects_and_its_list_limit(void **state)
{
    (void)state;
    static const char *const papers[] = {",-visibility",    ",-plane_reflection", ",-rows",
                                         ",-occlusion",     ",-ambiguity",        ",-merging",
                                         ",-superposition", ",-threshold",        ",-angle_noise",
                                         ",-range_noise",   ",-final_threshold",  ",-list_limit"};
    struct bench bench;
    measure(&bench, 0);
    const struct tried_chain *paper = &bench.cost.chains.items[1];
    assert_string_equal(paper->chain, "paper");
    size_t left_out = 0;
    for (const char *at = paper->effects; (at = strstr(at, ",-")) != NULL; at++)
        left_out++;
    assert_int_equal(left_out, EFFECT_COUNT - sizeof papers / sizeof *papers);
    for (size_t i = 0; i < sizeof papers / sizeof *papers; i++)
        if (strstr(paper->effects, papers[i]) != NULL)
            fail_msg("the paper's chain leaves out %s: %s", papers[i], paper->effects);
    assert_string_equal(bench.cost.chains.items[0].effects, paper->effects);
    end(&bench);
}

/* Times and errors that no machine changes. */
static void set_chain(struct cost *cost, size_t at, double us, double error)
{
    cost->chains.items[at].us_per_frame = us;
    cost->chains.items[at].energy.value = error;
    cost->chains.items[at].relative_distance = (struct relative_error){error, error, error, 0};
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
        const struct tried_chain *found = cost_find(&bench.cost, cases[i].bound, cases[i].most);
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

/* Without merging the chain is faster with every seed, without angle noise only with most. */
static void an_effect_stays_unless_its_time_is_told_from_nothing(void **state)
{
    (void)state;
    struct bench bench;
    measure(&bench, EFFECT_BIT(EFFECT_MERGING) | EFFECT_BIT(EFFECT_ANGLE_NOISE));
    for (size_t i = 0; i < bench.cost.chains.count; i++)
        set_chain(&bench.cost, i, 100, 0.1);
    struct tried_chain *chains = bench.cost.chains.items;
    chains[3].us_per_frame = 90, chains[3].saved = 0.1, chains[3].saved_least = 0.001;
    chains[4].us_per_frame = 50, chains[4].saved = 0.5, chains[4].saved_least = -0.001;
    const struct tried_chain *found = cost_find(&bench.cost, COST_BOUND_ERROR, 1);
    assert_non_null(found);
    assert_string_equal(found->chain, "auto, no merging");
    end(&bench);
}

static void without_an_error_of_ideal_echoes_nothing_is_found(void **state)
{
    (void)state;
    struct bench bench;
    measure(&bench, 0);
    bench.cost.chains.items[0].present = CHAIN_TRIALS_ENERGY;
    assert_null(cost_find(&bench.cost, COST_BOUND_ERROR, 1));
    assert_int_equal(bench.runner.diag.code, DIAG_DATA);
    assert_memory_equal(bench.runner.diag.text, "ideal echoes cannot be told from the reference",
                        46);
    end(&bench);
}

enum { SEEDS = CHAIN_TRIALS_SEEDS, ALL = 2 * SEEDS, MATRIX = ALL * ALL };

/* Distances between lists of which those of one law lie 1 apart, and those of two laws
 * `apart`: D is 2 (apart - 1), without scatter. */
static struct energy_sample lists_of(double apart, struct arena *arena)
{
    double *distance = arena_get(arena, MATRIX * sizeof *distance);
    for (size_t i = 0; i < ALL; i++)
        for (size_t j = 0; j < ALL; j++)
            distance[i * ALL + j] = i == j ? 0 : (i < SEEDS) == (j < SEEDS) ? 1 : apart;
    return (struct energy_sample){distance, SEEDS, SEEDS};
}

static void add_chain(struct cost *cost, const char *name, const char *effects, double us,
                      double apart, struct arena *arena)
{
    double error = apart - 1; /* ideal echoes lie 2 apart */
    struct tried_chain *chain = list_add(&cost->chains, arena);
    *chain = (struct tried_chain){
        .chain = name,
        .effects = effects,
        .us_per_frame = us,
        .targets_per_scan = 2.5,
        .lists = lists_of(apart, arena),
        .energy = {2 * error, error, 3 * error, 0},
        .relative_distance = {error, 0.5 * error, 2 * error, 0},
        .present = CHAIN_TRIALS_ENERGY | CHAIN_TRIALS_ERROR,
        .automatic = strncmp(name, "auto", 4) == 0,
    };
    *list_add(&chain->programs, arena) = "glint-sensor";
    *list_add(&chain->programs, arena) = "glint-noise";
}

/* Ideal echoes, the whole chain, and one effect less; runner is of any stage. */
static struct cost sample_cost(struct runner *runner, struct arena *arena)
{
    struct cost cost = {.suite = "my suite",
                        .reference = COST_ALL,
                        .frames = 12,
                        .seen_frames = 120,
                        .scenes = 1,
                        .scale = {0.181, 0.309, 0.204},
                        .runner = runner};
    begin_stage(runner, "noise", NO_WORDS);
    add_chain(&cost, "perfect", "none", 5, 2, arena);
    add_chain(&cost, "paper", "rows", 8, 1.1, arena);
    add_chain(&cost, "auto", "auto", 20, 1, arena);
    add_chain(&cost, "auto, no ghosts", "auto,-ghosts", 12.5, 1.02, arena);
    cost.chains.items[3].left_out = EFFECT_BIT(EFFECT_GHOSTS);
    return cost;
}

static void expect_text(struct text *text, const char *expected)
{
    text_add(text, "", 1);
    assert_string_equal(text->bytes, expected);
    text_free(text);
}

static void a_table_has_a_row_for_each_chain_and_says_what_is_missing(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct runner runner;
    struct text text = {0};
    struct cost cost = sample_cost(&runner, &arena);
    cost.no_signal = "the suite has no waveform";
    cost.chains.items[2].relative_distance = (struct relative_error){0, 0, 0.014, 0};
    cost.chains.items[3].present = 0;
    cost_write_table(&cost, &text);
    expect_text(
        &text,
        "12 of 120 frames of 1 scene, seen by my suite, with 6 seeds.\n"
        "Errors are distances from all effects of the suite, in % of those of ideal echoes "
        "(roots of energy distances).\n"
        "Their 95 % intervals hold for these frames under other seeds, not for other scenes.\n"
        "For scale: losing 30 % of all targets gives 18 %, losing half of them 31 %, moving all "
        "ranges by a cell 20 %.\n"
        "\n"
        "chain                         us a frame     error          interval  targets\n"
        "perfect                              5.0   100.0 %     50.0 to 200.0     2.50\n"
        "paper                                8.0    10.0 %      5.0 to  20.0     2.50\n"
        "auto                                20.0    <1.4 %      0.0 to   1.4     2.50\n"
        "auto, no ghosts                     12.5 reference                       2.50\n"
        "signal                       left out: the suite has no waveform\n");
    runner_free(&runner);
    arena_free(&arena);
}

static void a_table_without_errors_says_why(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct runner runner;
    struct text text = {0};
    struct cost cost = sample_cost(&runner, &arena);
    for (size_t i = 0; i < 4; i++)
        cost.chains.items[i].present = CHAIN_TRIALS_ENERGY;
    cost_write_table(&cost, &text);
    text_add(&text, "", 1);
    assert_non_null(strstr(text.bytes, "There are none: ideal echoes cannot be told from the "
                                       "reference (D 2, 1 to 3).\n"));
    assert_non_null(strstr(text.bytes, "\npaper                                8.0         -"));
    text_free(&text);
    runner_free(&runner);
    arena_free(&arena);
}

static void a_pipeline_is_that_of_its_chain_under_what_it_saves(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct runner runner;
    struct text text = {0};
    struct cost cost = sample_cost(&runner, &arena);
    cost_write_pipeline(&cost, &cost.chains.items[3], &text);
    expect_text(
        &text,
        "# 12 of 120 frames of 1 scene, seen by my suite, with 6 seeds.\n"
        "# Errors are distances from all effects of the suite, in % of those of ideal echoes "
        "(roots of energy distances).\n"
        "# Their 95 % intervals hold for these frames under other seeds, not for other scenes.\n"
        "# For scale: losing 30 % of all targets gives 18 %, losing half of them 31 %, moving all "
        "ranges by a cell 20 %.\n"
        "# This takes 12.5 us a frame instead of 20.0, with an error of 2.0 % (1.0 to 4.0).\n"
        "# If one effect alone is off, the squared error grows by these points; an error of 10 % "
        "is 1 point.\n"
        "# ghosts            off: saves 7.5 us, adds 2.0 (2.0 to 2.0)\n"
        "set -o pipefail\n"
        "glint-extract \\\n"
        "  | glint-ideal --sensors 'my suite' --effects auto,-ghosts \\\n"
        "  | glint-sensor \\\n"
        "  | glint-noise\n");
    runner_free(&runner);
    arena_free(&arena);
}

static void the_reference_itself_has_no_error(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct runner runner;
    struct text text = {0};
    struct cost cost = sample_cost(&runner, &arena);
    cost.reference = COST_SIGNAL;
    cost.scenes = 2;
    cost.chains.items[2].present = 0;
    cost_write_pipeline(&cost, &cost.chains.items[2], &text);
    text_add(&text, "", 1);
    assert_non_null(strstr(text.bytes, " of 2 scenes, "));
    assert_non_null(strstr(text.bytes, "# Errors are distances from the signal, "));
    assert_non_null(strstr(text.bytes, "of 20.0, with an error of 0 by definition.\nset "));
    text_free(&text);
    runner_free(&runner);
    arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_reference_is_the_signal_where_there_is_one),
        cmocka_unit_test(a_sample_has_250_frames_or_fewer_where_the_signal_is_long),
        cmocka_unit_test(chains_leave_out_each_effect_that_the_frames_call_for),
        cmocka_unit_test(the_chain_of_the_paper_has_the_papers_effects_and_its_list_limit),
        cmocka_unit_test(the_cheapest_or_the_most_accurate_chain_within_the_bound_is_found),
        cmocka_unit_test(an_effect_stays_unless_its_time_is_told_from_nothing),
        cmocka_unit_test(without_an_error_of_ideal_echoes_nothing_is_found),
        cmocka_unit_test(a_table_has_a_row_for_each_chain_and_says_what_is_missing),
        cmocka_unit_test(a_table_without_errors_says_why),
        cmocka_unit_test(a_pipeline_is_that_of_its_chain_under_what_it_saves),
        cmocka_unit_test(the_reference_itself_has_no_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
