#include "run/cost.h"

#include <assert.h>
#include <inttypes.h>

#include "base/elementary.h"
#include "effects/effect.h"
#include "run/trial_options.h"

enum { FRAMES = 250, FEWEST_FRAMES = 16, SIGNAL_SAMPLES = 32000000 };

static const char SENSOR[] = "glint-sensor", NOISE[] = "glint-noise",
                  SIGNAL[] = "glint-sensor-signal";

/* The complex samples of one scan of all sensors; 0 if one of them has no waveform. */
static int64_t signal_samples(const struct suite *suite)
{
    int64_t sum = 0;
    for (size_t i = 0; i < suite->sensors.count; i++) {
        const struct sensor *sensor = &suite->sensors.items[i];
        const struct waveform *waveform = &sensor->waveform;
        if (waveform->samples == 0)
            return 0;
        int64_t channels = sensor->beams.count > 0 ? (int64_t)sensor->beams.count : 2;
        sum += waveform->samples * waveform->repetitions * channels;
    }
    return sum;
}

/* Why the simulated signal is not the reference; NULL: it is. */
static const char *lack_of_signal(enum cost_reference reference, int64_t samples)
{
    if (reference == COST_ALL)
        return "it was not asked for";
    if (samples == 0)
        return "the suite has no waveform";
    if (stage_by_name(stage_name_in_path(SIGNAL)) == NULL)
        return "it is not installed beside this program";
    return NULL;
}

int cost_begin(struct cost *cost, const struct trial_options *options, struct runner *runner,
               enum cost_reference reference, int64_t frames)
{
    if (trial_begin(&cost->bench, options, runner) != 0)
        return -1;
    int64_t samples = signal_samples(suite_choice_load(runner, options->choice.sensors)),
            most = FRAMES;
    cost->runner = runner;
    cost->no_signal = lack_of_signal(reference, samples);
    if (cost->no_signal != NULL)
        reference = COST_ALL;
    else if (SIGNAL_SAMPLES / samples < most)
        most = SIGNAL_SAMPLES / samples > FEWEST_FRAMES ? SIGNAL_SAMPLES / samples : FEWEST_FRAMES;
    cost->sample =
        (struct frame_sample){.arena = runner_arena(runner), .most = frames > 0 ? frames : most};
    cost->table = (struct cost_table){.suite = options->choice.sensors,
                                      .reference = (int)reference,
                                      .no_signal = cost->no_signal,
                                      .seeds = CHAIN_TRIALS_SEEDS,
                                      .whole = COST_WHOLE};
    return 0;
}

void cost_free(struct cost *cost)
{
    arena_free(&cost->trials.kept);
    trial_end(&cost->bench);
}

static struct tried_chain *ideal(const struct cost *cost)
{
    return cost->chains.list.items[COST_IDEAL];
}

static struct tried_chain *whole(const struct cost *cost)
{
    return cost->chains.list.items[COST_WHOLE];
}

/* What a table calls the whole chain but for these effects: "auto", "auto, no ghosts", "auto, 14
 * left out". */
static const char *name_without(const struct cost *cost, uint64_t left_out)
{
    struct arena *arena = runner_arena(cost->runner);
    const char *asked = cost->bench.asked;
    int count = 0;
    for (uint64_t rest = left_out; rest != 0; rest &= rest - 1)
        count++;
    if (count == 0)
        return asked;
    if (count == 1)
        return arena_format(arena, "%s, no %s", asked, trial_names(left_out, arena));
    return arena_format(arena, "%s, %d left out", asked, count);
}

bool cost_has_errors(const struct cost *cost)
{
    return (ideal(cost)->row.present & COST_ERROR) != 0;
}

/* Sets up a chain with a trial of its own. */
static void prepare(struct cost *cost, struct tried_chain *chain, const char *name,
                    struct trial trial)
{
    chain->row.chain = name;
    chain->trial = &chain->own;
    chain->own = trial;
    chain->own.effect = EFFECT_NONE;
    trial_prepare(&cost->bench, chain->trial);
}

static struct tried_chain *add_chain(struct cost *cost)
{
    struct arena *arena = runner_arena(cost->runner);
    return *list_add(&cost->chains.list, arena) = arena_get(arena, sizeof(struct tried_chain));
}

/* Adds the whole chain, or that but for one effect, with a trial of the bench. */
static void add_automatic(struct cost *cost, struct trial *trial, uint64_t left_out)
{
    struct tried_chain *chain = add_chain(cost);
    chain->row.chain = name_without(cost, left_out);
    chain->trial = trial;
    chain->automatic = true;
    chain->left_out = left_out;
}

/* The set of effects of the paper's model. */
static uint64_t effects_of_paper(void)
{
    uint64_t effects = 0;
    for (int i = 0; i < EFFECT_COUNT; i++)
        if (effect_table[i]->of_paper)
            effects |= EFFECT_BIT(i);
    return effects;
}

/* Lists the chains of the table. */
static void add_chains(struct cost *cost)
{
    struct trial_bench *bench = &cost->bench;
    const char *paper = trial_request(effects_of_paper(), runner_arena(cost->runner));
    const char *all = bench->whole[TRIAL_IDEAL].effects;
    prepare(
        cost, add_chain(cost), "perfect",
        (struct trial){.effects = paper, .programs = {"glint-sensor-perfect", "glint-noise-none"}});
    prepare(cost, add_chain(cost), "paper",
            (struct trial){.effects = paper, .programs = {SENSOR, NOISE}});
    add_automatic(cost, &bench->whole[TRIAL_IDEAL], 0);
    for (int i = 0; i < EFFECT_COUNT && !cost->brief; i++)
        if ((bench->allowed & EFFECT_BIT(i)) != 0)
            add_automatic(cost, &bench->without[i], EFFECT_BIT(i));
    prepare(cost, add_chain(cost), "smear",
            (struct trial){
                .effects = all, .programs = {"glint-sensor-smear", NOISE}, .first = TRIAL_SENSOR});
}

static void set_errors(struct cost *cost, struct tried_chain *chain)
{
    struct cost_chain *row = &chain->row;
    row->energy = relative_error_of(&chain->lists, NULL);
    row->present = COST_ENERGY;
    if (chain == ideal(cost) ? row->energy.low <= 0 : !cost_has_errors(cost))
        return;
    row->relative_distance =
        relative_error_root(relative_error_of(&chain->lists, &ideal(cost)->lists));
    row->present |= COST_ERROR;
}

/* Sets the time of a chain that ran beside the whole one. */
static void set_time(struct cost *cost, struct tried_chain *chain)
{
    struct trial_bench *bench = &cost->bench;
    bool paper =
        chain == cost->chains.list.items[COST_PAPER] && (effects_of_paper() & ~bench->allowed) == 0;
    chain->saved = trial_saved(bench, chain->trial);
    struct trial_time time = trial_time_of(bench, &bench->whole[TRIAL_IDEAL]);
    if (chain == whole(cost))
        cost_table_whole(&chain->row, chain->trial, time, runner_arena(cost->runner));
    else
        cost_table_chain(&chain->row, chain->trial, time, chain->saved, paper || chain->automatic,
                         runner_arena(cost->runner));
}

/* Runs all chains in turns, and keeps those that leave out nothing, or what the frames call for. Of
 * ideal echoes, which know only of ideal, and the paper notes what they leave out. */
static int run_chains(struct cost *cost)
{
    struct trial_bench *bench = &cost->bench;
    struct tried_chains chains = {0}, *all = &cost->chains;
    *list_add(&chains.list, runner_arena(cost->runner)) = whole(cost);
    for (size_t i = 0; i < all->list.count; i++)
        if (i != COST_WHOLE)
            *list_add(&chains.list, runner_arena(cost->runner)) = all->list.items[i];
    unsigned effects = cost->brief ? 0 : TRIAL_EFFECTS;
    if (chain_trials_run(&cost->trials, &chains, TRIAL_TIMED | TRIAL_COMPARED | effects) != 0)
        return -1;
    size_t kept = 0;
    for (size_t i = 0; i < all->list.count; i++) {
        enum effect_id effect = all->list.items[i]->trial->effect;
        if (effect == EFFECT_NONE || trial_simulated(bench, effect))
            all->list.items[kept++] = all->list.items[i];
    }
    all->list.count = kept;
    for (size_t i = 0; i < kept; i++) {
        set_time(cost, all->list.items[i]);
        set_errors(cost, all->list.items[i]);
    }
    for (enum effect_id i = 0; i < EFFECT_COUNT; i++) {
        bool needed = (bench->allowed & EFFECT_BIT(i)) != 0 && trial_simulated(bench, i);
        bool paper = effect_table[i]->of_paper;
        if (needed && (!paper || effect_table[i]->home != EFFECT_HOME_IDEAL))
            ideal(cost)->left_out |= EFFECT_BIT(i);
        if (needed && !paper)
            all->list.items[COST_PAPER]->left_out |= EFFECT_BIT(i);
    }
    return 0;
}

/* The error of spoiled lists of the reference (chain_trials_spoiled). */
static double spoiled(const struct cost *cost, double lost, double off_cells)
{
    double energy = chain_trials_spoiled(&cost->trials, lost, off_cells);
    return sqrt(elementary_max(energy, 0) / ideal(cost)->row.energy.value);
}

static void fill_table(struct cost *cost)
{
    struct arena *arena = runner_arena(cost->runner);
    struct cost_table *table = &cost->table;
    for (size_t i = 0; i < cost->chains.list.count; i++) {
        const struct tried_chain *chain = cost->chains.list.items[i];
        if (chain->trial->effect == EFFECT_NONE) {
            *list_add(&table->chains, arena) = chain->row;
            continue;
        }
        struct cost_effect *row = list_add(&table->effects, arena);
        *row = cost_table_effect(&cost->bench, chain->trial->effect);
        if (!cost_has_errors(cost))
            continue;
        row->present = COST_ERROR;
        row->squared_error_added = cost_added(cost, chain);
    }
    if (cost_has_errors(cost))
        table->scale =
            (struct cost_scale){spoiled(cost, 0.3, 0), spoiled(cost, 0.5, 0), spoiled(cost, 0, 1)};
}

static int run_reference(struct cost *cost)
{
    struct tried_chain *reference = &cost->reference;
    bool signal = cost->no_signal == NULL;
    prepare(cost, reference, "signal",
            (struct trial){.effects = "auto",
                           .programs = {signal ? SIGNAL : SENSOR, signal ? NULL : NOISE}});
    if (chain_trials_begin(&cost->trials, reference) != 0)
        return -1;
    cost_table_chain(&reference->row, reference->trial,
                     trial_time_of(&cost->bench, reference->trial), (struct trial_time){0}, false,
                     runner_arena(cost->runner));
    return 0;
}

int cost_measure(struct cost *cost)
{
    struct frame_sample *sample = &cost->sample;
    struct cost_table *table = &cost->table;
    frame_sample_thin(sample, sample->most);
    cost->trials = (struct chain_trials){.bench = &cost->bench, .sample = sample};
    if (run_reference(cost) != 0)
        return -1;
    add_chains(cost);
    if (run_chains(cost) != 0)
        return -1;
    if (cost->no_signal == NULL)
        *list_add(&cost->chains.list, runner_arena(cost->runner)) = &cost->reference;
    table->frames = table->timed_frames = (int64_t)sample->list.count;
    table->seen_frames = sample->seen;
    table->scenes = (int64_t)cost->trials.scenes;
    cost_table_take_vehicles(table, &cost->bench);
    table->lists = cost->bench.lists;
    fill_table(cost);
    return 0;
}

struct relative_error cost_added(const struct cost *cost, const struct tried_chain *chain)
{
    assert(cost_has_errors(cost));
    return relative_error_added(&chain->lists, &whole(cost)->lists, &ideal(cost)->lists,
                                runner_arena(cost->runner));
}

struct tried_chain *cost_chain_without(struct cost *cost, uint64_t left_out)
{
    struct arena *arena = runner_arena(cost->runner);
    struct tried_chain *chain = arena_get(arena, sizeof *chain);
    struct trial trial = {.effects = trial_request(cost->bench.allowed & ~left_out, arena),
                          .programs = {SENSOR, NOISE}};
    prepare(cost, chain, name_without(cost, left_out), trial);
    chain->automatic = true;
    chain->left_out = left_out;
    return chain;
}

int cost_measure_error(struct cost *cost, struct tried_chain *chain)
{
    struct tried_chains chains = {0};
    *list_add(&chains.list, runner_arena(cost->runner)) = chain;
    if (chain_trials_run(&cost->trials, &chains, TRIAL_ALONE) != 0)
        return -1;
    set_errors(cost, chain);
    return 0;
}

int cost_measure_time(struct cost *cost, struct tried_chain *chain)
{
    if (chain_trials_time(&cost->trials, chain) != 0)
        return -1;
    set_time(cost, chain);
    return 0;
}

static void write_head(const struct cost *cost, const char *mark, struct text *text)
{
    const struct cost_table *table = &cost->table;
    text_format(text, "%s%" PRId64 " of %" PRId64 " frames of ", mark, table->frames,
                table->seen_frames);
    cost_table_write_scenes(table, text);
    text_format(text, ", with %d seeds.\n", CHAIN_TRIALS_SEEDS);
    text_format(text,
                "%sErrors are distances from %s, in %% of those of ideal echoes (roots of energy "
                "distances).\n%sTheir 95 %% intervals hold for these frames under other seeds, not "
                "for other scenes.\n",
                mark, cost->no_signal == NULL ? "the signal" : "all effects of the suite", mark);
    if (cost_has_errors(cost))
        text_format(text,
                    "%sFor scale: losing 30 %% of all targets gives %.0f %%, losing half of them "
                    "%.0f %%, moving all ranges by a cell %.0f %%.\n",
                    mark, 100 * table->scale.lost_30_percent, 100 * table->scale.lost_half,
                    100 * table->scale.one_cell_off);
}

void cost_write(const struct cost *cost, const struct tried_chain *chosen, struct text *text)
{
    const struct relative_error *energy = &ideal(cost)->row.energy;
    const char *mark = chosen != NULL ? "# " : "";
    write_head(cost, mark, text);
    if (!cost_has_errors(cost))
        text_format(text,
                    "There are none: ideal echoes cannot be told from the reference (D %.3g, %.3g "
                    "to %.3g).\n",
                    energy->value, energy->low, energy->high);
    else if (!cost->brief)
        text_format(text,
                    "%sErrors that effects add are squared, in points: an error of 10 %% is 1 "
                    "point.\n",
                    mark);
    cost_table_write(&cost->table, mark, chosen != NULL ? chosen->left_out : UINT64_MAX, text);
    if (chosen != NULL)
        cost_table_write_pipeline(&cost->table, &chosen->row, &whole(cost)->row, text);
}
