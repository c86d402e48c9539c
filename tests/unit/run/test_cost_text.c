#include "run_bench.h"

#include "run/cost_text.h"

enum { SEEDS = LADDER_SEEDS, ALL = 2 * SEEDS, MATRIX = ALL * ALL };

/* Distances of one block between lists of which those of one law lie 1 apart, and those of two laws
 * `apart`: D is 2 (apart - 1), without scatter. */
static struct energy_blocks blocks_of(double apart, struct arena *arena)
{
    static const double weight = 1;
    double *distance = arena_get(arena, MATRIX * sizeof *distance);
    for (size_t i = 0; i < ALL; i++)
        for (size_t j = 0; j < ALL; j++)
            distance[i * ALL + j] = i == j ? 0 : (i < SEEDS) == (j < SEEDS) ? 1 : apart;
    return (struct energy_blocks){distance, &weight, 1, SEEDS, SEEDS};
}

static void add_chain(struct cost *cost, const char *name, const char *effects, double us,
                      double apart, struct arena *arena)
{
    double error = apart - 1; /* ideal echoes lie 2 apart */
    struct ladder_chain *chain = list_add(&cost->chains, arena);
    *chain = (struct ladder_chain){
        .chain = name,
        .effects = effects,
        .us_per_frame = us,
        .targets_per_scan = 2.5,
        .blocks = blocks_of(apart, arena),
        .energy = {2 * error, error, 3 * error},
        .error = {error, 0.5 * error, 2 * error},
        .present = LADDER_ENERGY | LADDER_ERROR,
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
                        .blocks = 10,
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
    cost.chains.items[2].error = (struct relative_error){-0.0004, -0.01, 0.01}; /* no "-0.0" */
    cost.chains.items[3].present = 0;
    cost_text_table(&cost, &text);
    expect_text(
        &text,
        "12 of 120 frames of 1 scene in 10 blocks, seen by my suite, with 4 seeds.\n"
        "Errors are from all that the suite describes with other seeds, in % of those of ideal "
        "echoes, with 95 % intervals.\n"
        "\n"
        "chain                         us a frame     error          interval  targets\n"
        "perfect                              5.0   100.0 %     50.0 to 200.0     2.50\n"
        "paper                                8.0    10.0 %      5.0 to  20.0     2.50\n"
        "auto                                20.0     0.0 %     -1.0 to   1.0     2.50\n"
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
        cost.chains.items[i].present = LADDER_ENERGY;
    cost_text_table(&cost, &text);
    text_add(&text, "", 1);
    assert_non_null(strstr(text.bytes, "There are none: ideal echoes are not told from the "
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
    cost_text_pipeline(&cost, &cost.chains.items[3], &text);
    expect_text(
        &text,
        "# 12 of 120 frames of 1 scene in 10 blocks, seen by my suite, with 4 seeds.\n"
        "# Errors are from all that the suite describes with other seeds, in % of those of ideal "
        "echoes, with 95 % intervals.\n"
        "# This takes 12.5 us a frame instead of 20.0, with an error of 2.0 % (1.0 to 4.0).\n"
        "# ghosts            off: saves 7.5 us, adds 2.0 % (2.0 to 2.0)\n"
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
    cost.blocks = 1;
    cost.chains.items[2].present = 0;
    cost_text_pipeline(&cost, &cost.chains.items[2], &text);
    text_add(&text, "", 1);
    assert_non_null(strstr(text.bytes, " of 2 scenes in 1 block, "));
    assert_non_null(strstr(text.bytes, "# Errors are from the signal with other seeds, "));
    assert_non_null(strstr(text.bytes, "of 20.0, with an error of 0 by definition.\nset "));
    text_free(&text);
    runner_free(&runner);
    arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_has_a_row_for_each_chain_and_says_what_is_missing),
        cmocka_unit_test(a_table_without_errors_says_why),
        cmocka_unit_test(a_pipeline_is_that_of_its_chain_under_what_it_saves),
        cmocka_unit_test(the_reference_itself_has_no_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
