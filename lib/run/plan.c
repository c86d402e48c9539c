#include "run/plan.h"

#include <inttypes.h>

#include "base/elementary.h"
#include "effects/effect.h"
#include "run/trial_options.h"

/* The whole chain without its choice of effects in each scan: "all,-rows" for "auto,-rows". */
static void try_without_choice(struct plan *plan)
{
    static const char chosen[] = "auto";
    struct trial_bench *bench = &plan->bench;
    const char *asked = bench->asked;
    if (strncmp(asked, chosen, strlen(chosen)) != 0)
        return;
    plan->everywhere = bench->whole[TRIAL_IDEAL];
    plan->everywhere.effects =
        arena_format(runner_arena(plan->runner), "all%s", asked + strlen(chosen));
    trial_prepare(bench, &plan->everywhere);
    trial_add(bench, &plan->everywhere);
}

int plan_begin(struct plan *plan, const struct trial_options *options, struct runner *runner)
{
    struct trial_bench *bench = &plan->bench;
    if (trial_begin(bench, options, runner) != 0)
        return -1;
    plan->runner = runner;
    plan->sample = (struct frame_sample){.arena = runner_arena(runner), .most = INT64_MAX};
    plan->table =
        (struct cost_table){.suite = options->choice.sensors, .reference = -1, .seeds = 1};
    trial_begin_pass(bench, TRIAL_COMPARED | TRIAL_EFFECTS);
    for (int i = 0; i < PLAN_STAGES; i++) {
        plan->stand_ins[i] = bench->whole[TRIAL_SENSOR + i];
        plan->stand_ins[i].programs[i] = i == 0 ? "glint-sensor-perfect" : "glint-noise-none";
        trial_prepare(bench, &plan->stand_ins[i]);
        trial_add(bench, &plan->stand_ins[i]);
    }
    try_without_choice(plan);
    return 0;
}

int plan_try(struct plan *plan, const struct frame *frame)
{
    struct diag *diag = runner_diag(plan->runner);
    if (frame_sample_add(&plan->sample, frame, diag) != 0)
        return -1;
    const struct sampled_frame *kept = &plan->sample.list.items[plan->sample.list.count - 1];
    return trial_run(&plan->bench, kept, kept->seed);
}

/* The chain with stages replaced and effects left out, but for those of a replaced stage. */
static void make_pipeline(struct plan *plan)
{
    struct trial *pipeline = &plan->pipeline;
    uint64_t left_out = plan->left_out;
    *pipeline = plan->bench.whole[TRIAL_IDEAL];
    for (int i = 0; i < PLAN_STAGES; i++) {
        if (!plan->replaced[i])
            continue;
        pipeline->programs[i] = plan->stand_ins[i].programs[i];
        for (int at = 0; at < EFFECT_COUNT; at++)
            if (effect_table[at]->home == EFFECT_HOME_SENSOR + (unsigned)i)
                left_out &= ~EFFECT_BIT(at);
    }
    pipeline->effects = trial_request(plan->bench.allowed & ~left_out, runner_arena(plan->runner));
    trial_prepare(&plan->bench, pipeline);
}

/* Runs the pipeline: 1 if no list differs, 0 if one does, or -1 after a message. */
static int is_exact(struct plan *plan)
{
    make_pipeline(plan);
    trial_begin_pass(&plan->bench, TRIAL_COMPARED);
    trial_add(&plan->bench, &plan->pipeline);
    for (size_t i = 0; i < plan->sample.list.count && plan->pipeline.changed == 0; i++) {
        const struct sampled_frame *kept = &plan->sample.list.items[i];
        if (trial_run(&plan->bench, kept, kept->seed) != 0)
            return -1;
    }
    return plan->pipeline.changed == 0;
}

/* Puts back what comes last of what is left out: a stage, and then the last effect in the order of
 * the chain. */
static void put_back(struct plan *plan)
{
    bool *replaced = &plan->replaced[plan->replaced[PLAN_STAGES - 1]];
    int last = EFFECT_COUNT - 1;
    while (last > 0 && (plan->left_out & EFFECT_BIT(last)) == 0)
        last--;
    if (!*replaced)
        plan->left_out &= ~EFFECT_BIT(last);
    *replaced = false;
}

/* Leaves out all that is idle, and puts back part by part while a list differs. */
static int prove(struct plan *plan)
{
    for (enum effect_id i = 0; i < EFFECT_COUNT; i++)
        if (trial_simulated(&plan->bench, i) && plan->bench.without[i].changed == 0)
            plan->idle |= EFFECT_BIT(i);
    plan->left_out = plan->idle;
    for (int i = 0; i < PLAN_STAGES; i++)
        plan->replaced[i] = plan->stand_ins[i].changed == 0;
    for (int i = 0; i < EFFECT_COUNT + PLAN_STAGES; i++) {
        int exact = is_exact(plan);
        if (exact != 0)
            return exact < 0 ? -1 : 0;
        put_back(plan);
    }
    return 0;
}

/* All trials in turns, on a part of the frames. */
static int measure(struct plan *plan)
{
    struct trial_bench *bench = &plan->bench;
    frame_sample_thin(&plan->sample, PLAN_TIMED_FRAMES);
    trial_begin_pass(bench, TRIAL_TIMED | TRIAL_EFFECTS);
    trial_add(bench, &plan->pipeline);
    if (plan->everywhere.effects != NULL)
        trial_add(bench, &plan->everywhere);
    for (bench->round = 0; bench->round < TRIAL_ROUNDS; bench->round++)
        for (size_t i = 0; i < plan->sample.list.count; i++)
            if (trial_run(bench, &plan->sample.list.items[i], plan->sample.list.items[i].seed) != 0)
                return -1;
    return 0;
}

/* Adds the row of a chain beside the whole one: it has the same lists, or no error is said of it.
 */
static void add_row(struct plan *plan, const char *name, const struct trial *trial, bool part,
                    struct trial_time whole)
{
    struct arena *arena = runner_arena(plan->runner);
    struct cost_chain *chain = list_add(&plan->table.chains, arena);
    chain->chain = name;
    chain->targets_per_scan = plan->table.chains.items[0].targets_per_scan;
    chain->present = COST_ENERGY | (trial->changed == 0 ? COST_ERROR : 0);
    cost_table_chain(chain, trial, whole, trial_saved(&plan->bench, trial), part, arena);
}

static void fill_table(struct plan *plan, double targets_per_scan)
{
    const struct trial_bench *bench = &plan->bench;
    const struct trial *whole = &bench->whole[TRIAL_IDEAL];
    struct arena *arena = runner_arena(plan->runner);
    struct trial_time time = trial_time_of(bench, whole);
    struct cost_chain *chain = list_add(&plan->table.chains, arena);
    chain->chain = bench->asked;
    chain->targets_per_scan = targets_per_scan;
    cost_table_whole(chain, whole, time, arena);
    add_row(plan, "planned", &plan->pipeline, true, time);
    if (plan->everywhere.effects != NULL)
        add_row(plan, plan->everywhere.effects, &plan->everywhere, false, time);
    plan->table.chosen = plan->table.chains.items[1].chain;
    for (enum effect_id i = 0; i < EFFECT_COUNT; i++)
        if (trial_simulated(bench, i))
            *list_add(&plan->table.effects, arena) = cost_table_effect(bench, i);
}

int plan_end(struct plan *plan)
{
    struct cost_table *table = &plan->table;
    table->frames = table->seen_frames = plan->sample.seen;
    table->scenes = (int64_t)plan->sample.names.list.count;
    cost_table_take_vehicles(table, &plan->bench);
    table->lists = plan->bench.lists;
    if (plan->sample.seen == 0)
        return 0;
    double targets_per_scan = (double)plan->bench.targets / elementary_max((double)table->lists, 1);
    memcpy(plan->log, plan->bench.log, sizeof plan->log);
    if (prove(plan) != 0 || measure(plan) != 0)
        return -1;
    table->timed_frames = (int64_t)plan->sample.list.count;
    fill_table(plan, targets_per_scan);
    return 0;
}

void plan_free(struct plan *plan)
{
    trial_end(&plan->bench);
}

static void write_reason(const struct plan *plan, int effect, struct text *text)
{
    const struct effect *entry = effect_table[effect];
    const struct effect_log *log = &plan->log[entry->home];
    const char *left_out = log->scans_left_out[effect] > 0 ? entry->left_out_when : NULL;
    text_format(text, "# %-17s ", effects_names[effect]);
    if ((plan->bench.allowed & EFFECT_BIT(effect)) == 0)
        text_add_word(text, "off: not asked for\n");
    else if (log->scans_simulated[effect] > 0)
        text_format(text, "on in %" PRId64 " of %" PRId64 " scans: %s%s%s\n",
                    log->scans_simulated[effect], log->scans, entry->cause,
                    left_out != NULL ? "; in the others " : "", left_out != NULL ? left_out : "");
    else if (left_out != NULL)
        text_format(text, "off: %s\n", left_out);
    else
        text_format(text, "off: nothing describes it (%s)\n", entry->cause);
}

/* Effects that are simulated, and change no list. */
static void write_idle(const struct plan *plan, struct text *text)
{
    struct arena *arena = runner_arena(plan->runner);
    uint64_t back = plan->idle & ~plan->left_out;
    if (plan->idle != 0)
        text_format(text, "# Idle, as no list changes without one of them: %s\n",
                    trial_names(plan->idle, arena));
    if (back != 0)
        text_format(text, "# Put back, as lists change without all of them: %s\n",
                    trial_names(back, arena));
}

static void write_stage(const struct plan *plan, int at, struct text *text)
{
    const struct trial *trial = &plan->stand_ins[at];
    bool replaced = plan->replaced[at];
    text_format(text, "# %s %s: with %s, %" PRId64 " of %" PRId64 " lists change%s\n",
                plan->bench.whole[TRIAL_IDEAL].programs[at], replaced ? "goes" : "stays",
                trial->programs[at], trial->changed, plan->table.lists,
                trial->changed == 0 && !replaced ? ", but not without what is left out" : "");
}

void plan_write(const struct plan *plan, bool all, struct text *text)
{
    const struct cost_table *table = &plan->table;
    if (table->frames == 0)
        return;
    text_format(text, "# %" PRId64 " frame%s of ", table->frames, table->frames == 1 ? "" : "s");
    cost_table_write_scenes(table, text);
    text_format(text, ": %" PRId64 " lists of targets.\n", table->lists);
    cost_table_write(table, "# ", all ? UINT64_MAX : ~plan->idle, text);
    write_idle(plan, text);
    for (int i = 0; i < EFFECT_COUNT && all; i++)
        write_reason(plan, i, text);
    for (int i = 0; i < PLAN_STAGES; i++)
        write_stage(plan, i, text);
    cost_table_write_pipeline(table, &table->chains.items[1], &table->chains.items[0], text);
}
