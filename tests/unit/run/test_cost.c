#include "run_bench.h"

#include "run/cost.h"
#include "run/cost_search.h"
#include "run/trial_options.h"

struct bench {
    struct runner runner; /* of a tool */
    struct arena arena;
    struct cost cost;
};

static int begin(struct bench *bench, const char *suite, enum cost_reference reference,
                 int64_t frames)
{
    const struct trial_options options = {.choice = {suite, NULL}};
    *bench = (struct bench){0};
    begin_tool(&bench->runner, suite);
    return cost_begin(&bench->cost, &options, &bench->runner, reference, frames);
}

static void end(struct bench *bench)
{
    cost_free(&bench->cost);
    runner_free(&bench->runner);
    arena_free(&bench->arena);
}

static int make_bench(void **state)
{
    check_make(state, sizeof(struct bench));
    return 0;
}

static int remove_bench(void **state)
{
    end(*state);
    free(*state);
    return 0;
}

#define COST_TEST(name) TEST_WITH(make_bench, remove_bench, struct bench *bench, name)

/* The chains on 12 frames. */
static void measure(struct bench *bench, bool brief)
{
    assert_int_equal(begin(bench, "srr24-pair-every-frame", COST_ALL, 0), 0);
    bench->cost.brief = brief;
    bench->cost.sample = sample_of_traffic("12", &bench->arena);
    if (cost_measure(&bench->cost) != 0)
        fail_msg("%s", bench->runner.diag.text);
}

static struct tried_chain *chain_at(struct bench *bench, size_t at)
{
    return bench->cost.chains.list.items[at];
}

/* The chain without one effect. */
static struct tried_chain *without(struct bench *bench, enum effect_id effect)
{
    for (size_t i = 0; i < bench->cost.chains.list.count; i++)
        if (chain_at(bench, i)->trial->effect == effect)
            return chain_at(bench, i);
    fail_msg("no chain leaves out %s", effects_names[effect]);
    return NULL;
}

TEST(the_reference_is_the_signal_where_there_is_one)
{
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
        assert_int_equal(begin(&bench, cases[i].suite, cases[i].asked, 0), 0);
        bool built = stage_by_name("sensor-signal") != NULL;
        if (cases[i].no_signal != NULL)
            assert_string_equal(bench.cost.no_signal, cases[i].no_signal);
        else if (built)
            assert_null(bench.cost.no_signal);
        else
            print_message("left out: glint-sensor-signal is not built\n");
        if (built || cases[i].no_signal != NULL)
            assert_int_equal(bench.cost.table.reference, cases[i].reference);
        end(&bench);
    }
}

TEST(a_sample_has_250_frames_or_fewer_where_the_signal_is_long)
{
    struct bench bench;
    assert_int_equal(begin(&bench, "srr24-pair", COST_SIGNAL, 0), 0);
    assert_int_equal(bench.cost.sample.most, 250);
    end(&bench);
    assert_int_equal(begin(&bench, "srr24-pair", COST_SIGNAL, 7), 0);
    assert_int_equal(bench.cost.sample.most, 7);
    end(&bench);
    /* of 1,048,576 samples a frame */
    assert_int_equal(begin(&bench, "lrr77-signal-large", COST_SIGNAL, 0), 0);
    assert_int_equal(bench.cost.sample.most, bench.cost.no_signal == NULL ? 30 : 250);
    end(&bench);
    assert_int_equal(begin(&bench, "nowhere", COST_SIGNAL, 0), -1);
    end(&bench);
}

COST_TEST(an_effect_has_a_row_if_the_frames_call_for_it)
{
    static const char *const names[] = {"perfect", "paper", "auto", "smear"};
    measure(bench, false);
    const struct cost_table *table = &bench->cost.table;
    assert_int_equal(table->chains.count, 4);
    for (size_t i = 0; i < 4; i++) {
        assert_string_equal(table->chains.items[i].chain, names[i]);
        assert_int_equal(table->chains.items[i].present, COST_ENERGY | COST_ERROR);
    }
    assert_close(table->chains.items[0].relative_distance.value, 1, 1e-12);
    assert_string_equal(table->chains.items[2].effects, "auto");
    assert_string_equal(table->chains.items[3].programs.items[0], "glint-sensor-smear");
    assert_int_equal(table->effects.count, bench->cost.chains.list.count - 4);
    for (size_t i = 0; i < table->effects.count; i++) {
        const struct cost_effect *row = &table->effects.items[i];
        assert_true(trial_simulated(&bench->cost.bench, row->effect));
        assert_in_range(row->lists_changed, 0, table->lists);
        if (row->lists_changed == 0)
            assert_close(row->squared_error_added.value, 0, 0);
    }
    assert_int_equal(table->lists, 144); /* of two sensors, with 6 seeds */
    assert_int_equal(table->frames, 12);
    assert_int_equal(table->seen_frames, 12);
    assert_int_equal(table->timed_frames, 12);
    assert_int_equal(table->scenes, 12);
    assert_true(table->scale.lost_30_percent > 0.05 && table->scale.one_cell_off > 0.05);
    assert_true(table->scale.lost_half > 1.2 * table->scale.lost_30_percent);
    assert_true(table->scale.lost_half < 1);
}

/* The squared error that an effect adds is a difference of energies over that of ideal echoes. */
COST_TEST(what_an_effect_adds_is_paired)
{
    measure(bench, false);
    const struct tried_chain *merging = without(bench, EFFECT_MERGING);
    const struct tried_chain *whole = chain_at(bench, COST_WHOLE);
    double energy = merging->row.energy.value - whole->row.energy.value;
    struct relative_error added = cost_added(&bench->cost, merging);
    assert_string_equal(merging->row.chain, "auto, no merging");
    assert_string_equal(merging->row.effects, "auto,-merging");
    assert_close(cost_added(&bench->cost, whole).value, 0, 1e-12);
    assert_close(added.value, energy / chain_at(bench, COST_IDEAL)->row.energy.value, 1e-12);
    struct relative_error error =
        relative_error_of(&merging->lists, &chain_at(bench, COST_IDEAL)->lists);
    assert_true(added.high - added.low < error.high - error.low);
}

COST_TEST(a_brief_cost_leaves_out_no_effect)
{
    measure(bench, true);
    assert_int_equal(bench->cost.chains.list.count, 4);
    assert_int_equal(bench->cost.table.effects.count, 0);
}

/* What Buehren and Yang's model has: the list of a radar is limited in it, too. */
COST_TEST(the_chain_of_the_paper_has_the_papers_effects_and_its_list_limit)
{
    static const char *const papers[] = {",-visibility",    ",-plane_reflection", ",-rows",
                                         ",-occlusion",     ",-ambiguity",        ",-merging",
                                         ",-superposition", ",-threshold",        ",-angle_noise",
                                         ",-range_noise",   ",-final_threshold",  ",-list_limit"};
    measure(bench, true);
    const struct cost_chain *paper = &chain_at(bench, COST_PAPER)->row;
    assert_string_equal(paper->chain, "paper");
    size_t left_out = 0;
    for (const char *at = paper->effects; (at = strstr(at, ",-")) != NULL; at++)
        left_out++;
    assert_int_equal(left_out, EFFECT_COUNT - sizeof papers / sizeof *papers);
    for (size_t i = 0; i < sizeof papers / sizeof *papers; i++)
        if (strstr(paper->effects, papers[i]) != NULL)
            fail_msg("the paper's chain leaves out %s: %s", papers[i], paper->effects);
    assert_string_equal(chain_at(bench, COST_IDEAL)->row.effects, paper->effects);
}

/* Times and errors that no machine changes. */
static void set_chain(struct tried_chain *chain, double us, double error)
{
    chain->row.us_per_frame = us;
    chain->row.energy.value = error;
    chain->row.relative_distance = (struct relative_error){error, error, error, 0};
}

COST_TEST(the_cheapest_or_the_most_accurate_chain_within_the_bound_is_found)
{
    static const struct {
        enum cost_search_bound bound;
        double most;
        const char *found;
    } cases[] = {
        {COST_SEARCH_ERROR, 0.3, "paper"}, {COST_SEARCH_ERROR, 0.09, "auto"},
        {COST_SEARCH_ERROR, 2, "paper"},   {COST_SEARCH_US, 100, "auto"},
        {COST_SEARCH_US, 12, "perfect"},   {COST_SEARCH_US, 10, "paper"},
    };
    measure(bench, true);
    assert_int_equal(bench->cost.chains.list.count, 4);
    set_chain(chain_at(bench, 0), 11, 0.2);
    set_chain(chain_at(bench, 1), 10, 0.25);
    set_chain(chain_at(bench, 2), 40, 0.01);
    set_chain(chain_at(bench, 3), 90, 0.02);
    for (size_t i = 0; i < COUNT(cases); i++) {
        const struct tried_chain *found = cost_search(&bench->cost, cases[i].bound, cases[i].most);
        assert_non_null(found);
        assert_string_equal(found->row.chain, cases[i].found);
        assert_ptr_equal(bench->cost.table.chosen, found->row.chain);
    }
    assert_null(cost_search(&bench->cost, COST_SEARCH_US, 9.99));
    assert_int_equal(bench->runner.diag.code, DIAG_DATA);
    assert_string_equal(bench->runner.diag.text,
                        "no chain holds the bound; the nearest, paper, takes 10.0 us a frame and "
                        "has an error of up to 25.0 %");
}

/* Without merging the chain is faster in every round, without angle noise only in most. */
COST_TEST(an_effect_stays_unless_its_time_is_told_from_nothing)
{
    measure(bench, false);
    for (size_t i = 0; i < bench->cost.chains.list.count; i++) {
        set_chain(chain_at(bench, i), 100, 0.1);
        chain_at(bench, i)->saved = (struct trial_time){0, -1, 1};
    }
    struct tried_chain *merging = without(bench, EFFECT_MERGING);
    struct tried_chain *noise = without(bench, EFFECT_ANGLE_NOISE);
    merging->row.us_per_frame = 90, merging->saved = (struct trial_time){10, 0.1, 12};
    noise->row.us_per_frame = 50, noise->saved = (struct trial_time){50, -0.1, 60};
    const struct tried_chain *found = cost_search(&bench->cost, COST_SEARCH_ERROR, 1);
    assert_non_null(found);
    assert_int_equal(found->left_out & ~EFFECT_BIT(EFFECT_MERGING), 0);
}

/* No chain without several effects that breaks the bound is chosen, and what is chosen is measured.
 */
TEST(a_bound_of_the_error_holds_for_what_is_found)
{
    struct bench bench;
    static const double bounds[] = {3, 0.5, 0.3};
    for (size_t i = 0; i < 3; i++) {
        measure(&bench, false);
        const struct tried_chain *found = cost_search(&bench.cost, COST_SEARCH_ERROR, bounds[i]);
        if (found == NULL)
            fail_msg("%s", bench.runner.diag.text);
        assert_true(found->row.relative_distance.high <= bounds[i]);
        assert_string_equal(bench.cost.table.chosen, found->row.chain);
        end(&bench);
    }
}

COST_TEST(without_an_error_of_ideal_echoes_nothing_is_found)
{
    measure(bench, true);
    chain_at(bench, COST_IDEAL)->row.present = COST_ENERGY;
    assert_null(cost_search(&bench->cost, COST_SEARCH_ERROR, 1));
    assert_int_equal(bench->runner.diag.code, DIAG_DATA);
    assert_memory_equal(bench->runner.diag.text, "ideal echoes cannot be told from the reference",
                        46);
}
