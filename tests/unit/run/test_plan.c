#include "run_bench.h"

#include "run/plan.h"
#include "run/trial_options.h"

struct bench {
    struct runner runner; /* of a tool */
    struct arena arena;
    struct plan plan;
};

static void begin(struct bench *bench, const char *effects)
{
    const struct trial_options options = {.choice = {"srr24-pair-every-frame", effects}};
    begin_tool(&bench->runner, options.choice.sensors);
    assert_int_equal(plan_begin(&bench->plan, &options, &bench->runner), 0);
}

/* Plans 12 snapshots of dense traffic. */
static void plan_traffic(struct bench *bench, const char *effects)
{
    struct arena scratch = {0};
    struct frame frame = {.arena = &scratch};
    begin(bench, effects);
    struct frame_sample sample = sample_of_traffic("12", &bench->arena);
    for (size_t i = 0; i < sample.list.count; i++) {
        assert_done(frame_stream_parse, sample.list.items[i].line, sample.list.items[i].length,
                    &frame);
        assert_int_equal(plan_try(&bench->plan, &frame), 0);
    }
    if (plan_end(&bench->plan) != 0)
        fail_msg("%s", bench->runner.diag.text);
    arena_free(&scratch);
}

static int end(void **state)
{
    struct bench *bench = *state;
    plan_free(&bench->plan);
    runner_free(&bench->runner);
    arena_free(&bench->arena);
    free(bench);
    return 0;
}

static int make_bench(void **state)
{
    check_make(state, sizeof(struct bench));
    return 0;
}

#define PLAN_TEST(name) TEST_WITH(make_bench, end, struct bench *bench, name)

static void assert_writes(const struct plan *plan, bool all, const char *part, bool expected)
{
    struct text *text = check_text();
    plan_write(plan, all, text);
    text_add(text, "", 1);
    if ((strstr(text->bytes, part) != NULL) != expected)
        fail_msg("\"%s\" is %sin:\n%s", part, expected ? "not " : "", text->bytes);
}

/* An effect is idle, or it changes a list and stays. */
PLAN_TEST(what_changes_no_list_leaves_the_pipeline)
{
    plan_traffic(bench, NULL);
    const struct plan *plan = &bench->plan;
    assert_int_equal(plan->left_out, plan->idle);
    assert_int_equal(plan->pipeline.changed, 0);
    assert_int_equal(plan->table.lists, 24); /* of two sensors */
    assert_int_equal(plan->table.frames, 12);
    assert_int_equal(plan->table.chains.count, 3);
    assert_string_equal(plan->table.chains.items[1].effects,
                        trial_request(~plan->idle & plan->bench.allowed, &bench->arena));
    for (size_t i = 0; i < plan->table.effects.count; i++) {
        const struct cost_effect *row = &plan->table.effects.items[i];
        assert_int_equal((plan->idle & EFFECT_BIT(row->effect)) != 0, row->lists_changed == 0);
        assert_in_range(row->lists_changed, 0, 24);
        assert_true(row->saved.least_us <= row->saved.us && row->saved.us <= row->saved.most_us);
        assert_non_null(row->called_for_by);
    }
    assert_true((plan->idle & EFFECT_BIT(EFFECT_ANGLE_NOISE)) == 0);
    assert_true((plan->idle & EFFECT_BIT(EFFECT_LIST_LIMIT)) != 0);
}

/* All effects in all scans have the lists of those that auto chooses. */
PLAN_TEST(the_choice_in_each_scan_stands_beside_all_effects)
{
    plan_traffic(bench, "auto,-rows");
    const struct cost_chain *row = &bench->plan.table.chains.items[2];
    assert_string_equal(row->chain, "all,-rows");
    assert_int_equal(row->present, COST_ENERGY | COST_ERROR);
    assert_true(row->us_per_frame > 0 && row->relative_distance.high == 0);
}

PLAN_TEST(a_choice_that_holds_for_all_scans_has_no_row_of_its_own)
{
    plan_traffic(bench, "rows,merging");
    assert_int_equal(bench->plan.table.chains.count, 2);
}

PLAN_TEST(idle_effects_are_rows_only_with_all)
{
    plan_traffic(bench, NULL);
    assert_writes(&bench->plan, false, "\n# Idle, as no list changes without one of them: ", true);
    assert_writes(&bench->plan, false, "\n# list_limit ", false);
    assert_writes(&bench->plan, true, "\n# list_limit                0 of 24 ", true);
    assert_writes(&bench->plan, false, "\n# merging ", true);
    assert_writes(&bench->plan, true, "\n# rain              off: rain_mmph is 0\n", true);
    assert_writes(&bench->plan, true, "\n# threshold         on in 24 of 24 scans: ", true);
    assert_writes(&bench->plan, false, " on in 24 of 24 scans: ", false);
}

PLAN_TEST(what_was_not_asked_for_says_so)
{
    plan_traffic(bench, "all,-merging");
    assert_writes(&bench->plan, true, "\n# merging           off: not asked for\n", true);
    assert_writes(&bench->plan, false, " --effects auto,-", true);
    assert_string_equal(bench->plan.table.chains.items[0].chain, "all,-merging");
}

/* Without an effect at home in noise, glint-noise-none writes the same. */
PLAN_TEST(a_stage_goes_where_another_gives_the_same_lists)
{
    plan_traffic(bench, "occlusion,merging,superposition,threshold");
    assert_writes(&bench->plan, false,
                  "\n# glint-noise goes: with glint-noise-none, 0 of 24 lists change\n", true);
    assert_writes(&bench->plan, false, "  | glint-sensor \\\n  | glint-noise-none\n", true);
    assert_writes(&bench->plan, false, "\n# glint-sensor stays: with glint-sensor-perfect, 2",
                  true);
}

/* Effects of which each does for the other: alone they change no list, and together they do. */
PLAN_TEST(what_is_put_back_is_named)
{
    plan_traffic(bench, NULL);
    struct plan *plan = &bench->plan;
    plan->idle = EFFECT_BIT(EFFECT_ANGLE_NOISE) | EFFECT_BIT(EFFECT_LIST_LIMIT);
    plan->left_out = EFFECT_BIT(EFFECT_LIST_LIMIT);
    assert_writes(plan, false, "\n# Put back, as lists change without all of them: angle_noise\n",
                  true);
}

PLAN_TEST(no_frames_make_no_plan)
{
    struct text *text = check_text();
    begin(bench, NULL);
    assert_int_equal(plan_end(&bench->plan), 0);
    plan_write(&bench->plan, true, text);
    assert_int_equal(text->length, 0);
}

/* The rounds of the whole chain lie 3 us apart. */
TEST(a_part_is_dearer_only_by_more_than_rounds_lie_apart)
{
    static const struct {
        struct trial_time saved;
        bool part;
        double us;
        bool close;
    } cases[] = {
        {{2, 1, 3}, true, 28, false},      {{1, -1, 2}, true, 29, true},
        {{-1, -2, 1}, true, 30, true},     {{-2, -4, -1}, true, 30, true},
        {{-5, -6, -3.5}, true, 35, false}, {{-2, -4, -1}, false, 32, false},
    };
    const struct trial trial = {.effects = "auto", .programs = {"glint-sensor", "glint-noise"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct cost_chain chain = {0};
        cost_table_chain(&chain, &trial, (struct trial_time){30, 28, 31}, cases[i].saved,
                         cases[i].part, check_arena());
        assert_true(chain.us_per_frame == cases[i].us);
        assert_int_equal(chain.close, cases[i].close);
    }
}
