#include "run/cost.h"

#include <inttypes.h>
#include <stdio.h>

#include "base/elementary.h"
#include "base/sort.h"
#include "effects/effect.h"
#include "run/plan.h"

enum { FRAMES = 250, FEWEST_FRAMES = 16, SIGNAL_SAMPLES = 32000000 };

/* The model of Buehren and Yang. Folding is the waveform's, which all chains have. */
static const uint64_t PAPER = EFFECT_BIT(EFFECT_VISIBILITY) | EFFECT_BIT(EFFECT_PLANE_REFLECTION) |
                              EFFECT_BIT(EFFECT_ROWS) | EFFECT_BIT(EFFECT_OCCLUSION) |
                              EFFECT_BIT(EFFECT_AMBIGUITY) | EFFECT_BIT(EFFECT_MERGING) |
                              EFFECT_BIT(EFFECT_SUPERPOSITION) | EFFECT_BIT(EFFECT_THRESHOLD) |
                              EFFECT_BIT(EFFECT_ANGLE_NOISE) | EFFECT_BIT(EFFECT_RANGE_NOISE) |
                              EFFECT_BIT(EFFECT_FINAL_THRESHOLD) | EFFECT_BIT(EFFECT_LIST_LIMIT);

static const char SENSOR[] = "glint-sensor", NOISE[] = "glint-noise",
                  SIGNAL[] = "glint-sensor-signal";

/* The effects of the reference. */
static const char REFERENCE[] = "auto";

const char *const cost_references[] = {"signal", "all", NULL};

static const struct field interval_fields[] = {
    {FIELD_REAL_IN(struct relative_error, value, -1e300, 1e300, "the figure")},
    {FIELD_REAL_IN(struct relative_error, low, -1e300, 1e300, "of its 95 % interval")},
    {FIELD_REAL_IN(struct relative_error, high, -1e300, 1e300, "of its 95 % interval")},
    {0},
};

static const struct record interval_record = {FIELD_TABLE(
    struct relative_error, interval_fields, "interval", "A figure with its 95 % interval.")};

static const struct field chain_fields[] = {
    {FIELD_NAME_OF(struct tried_chain, chain, "its name in the table")},
    {FIELD_NAME_OF(struct tried_chain, effects, "for glint-ideal --effects")},
    {FIELD_NAMES_OF(struct tried_chain, programs, "those after glint-ideal")},
    {FIELD_REAL_IN(struct tried_chain, us_per_frame, 0, 1e300,
                   "CPU time of a frame here, with reading and writing its line")},
    {FIELD_REAL_IN(struct tried_chain, targets_per_scan, 0, 1e300, "mean number in a list")},
    {OPTIONAL_RECORD(struct tried_chain, energy, &interval_record,
                     "energy distance from the reference, absent for itself"),
     .section = CHAIN_TRIALS_ENERGY},
    {OPTIONAL_RECORD(struct tried_chain, relative_distance, &interval_record,
                     "the error: root of energy over that of ideal echoes, 0 if energy is not "
                     "above 0; absent if ideal echoes cannot be told from the reference"),
     .section = CHAIN_TRIALS_ERROR},
    {0},
};

static const struct record chain_record = {
    FIELD_TABLE(struct tried_chain, chain_fields, "cost_chain", "A chain, as it was measured."),
    .present_offset = offsetof(struct tried_chain, present)};

static const struct field scale_fields[] = {
    {FIELD_REAL_IN(struct cost_scale, lost_30_percent, 0, 1e300, "30 % of all targets lost")},
    {FIELD_REAL_IN(struct cost_scale, lost_half, 0, 1e300, "half of all targets lost")},
    {FIELD_REAL_IN(struct cost_scale, one_cell_off, 0, 1e300, "all ranges moved by one cell")},
    {0},
};

static const struct record scale_record = {
    FIELD_TABLE(struct cost_scale, scale_fields, "cost_scale",
                "Errors of spoiled lists of the reference; 0 where chains have no errors.")};

static const struct field cost_fields[] = {
    {FIELD_NAME_OF(struct cost, suite, "as --sensors names it")},
    {FIELD_CHOICE_OF(struct cost, reference, cost_references,
                     "what errors are from; it has seeds of its own")},
    {FIELD_INTEGER_IN(struct cost, frames, 0, 0x1p53, "of the sample")},
    {FIELD_INTEGER_IN(struct cost, seen_frames, 0, 0x1p53, "of the stream")},
    {FIELD_INTEGER_IN(struct cost, scenes, 0, 0x1p53, "of the sample")},
    {FIELD_INTEGER_IN(struct cost, seeds, 0, 0x1p53,
                      "of every chain; the intervals hold for these frames under other seeds")},
    {FIELD_RECORD_OF(struct cost, scale, &scale_record, "to compare errors with")},
    {OPTIONAL_NAME(struct cost, chosen, "the chain that was found for a bound")},
    {FIELD_LIST_OF(struct cost, chains, &chain_record, "in the order in which they were measured")},
    {0},
};

const struct record cost_record = {FIELD_TABLE(
    struct cost, cost_fields, "cost", "What glint-cost --json writes: chains by time and error.")};

/* The complex samples of one scan of all sensors; 0 if one of them has no waveform. */
static int64_t signal_samples(const struct suite *suite)
{
    int64_t sum = 0;
    for (size_t i = 0; i < suite->sensors.count; i++) {
        const struct waveform *waveform = &suite->sensors.items[i].waveform;
        if (waveform->samples == 0)
            return 0;
        int64_t channels = waveform->elements > 0 ? waveform->elements : 2;
        sum += waveform->samples * waveform->repetitions * channels;
    }
    return sum;
}

int cost_begin(struct cost *cost, int64_t frames)
{
    struct arena *arena = runner_arena(cost->runner);
    const struct suite *suite = suite_choice_load(cost->runner, cost->suite);
    if (suite == NULL)
        return -1;
    suite_choice_doubt(cost->runner, suite);
    int64_t samples = signal_samples(suite), most = FRAMES;
    bool built = stage_by_name(stage_name_in_path(SIGNAL)) != NULL;
    cost->no_signal = cost->reference == COST_ALL ? "it was not asked for"
                      : samples == 0              ? "the suite has no waveform"
                      : !built                    ? "it is not installed beside this program"
                                                  : NULL;
    if (cost->no_signal != NULL)
        cost->reference = COST_ALL;
    else if (SIGNAL_SAMPLES / samples < most)
        most = SIGNAL_SAMPLES / samples > FEWEST_FRAMES ? SIGNAL_SAMPLES / samples : FEWEST_FRAMES;
    cost->sample = (struct frame_sample){.arena = arena, .most = frames > 0 ? frames : most};
    return 0;
}

static const struct tried_chain *ideal(const struct cost *cost)
{
    return &cost->chains.items[0];
}

/* The chain with all effects that were asked for: the third. */
static const struct tried_chain *whole(const struct cost *cost)
{
    return &cost->chains.items[2];
}

/* A chain that ends with these programs; other is NULL where the first stands in for both. */
static struct tried_chain chain_of(const struct cost *cost, const char *name, const char *effects,
                                   const char *program, const char *other)
{
    struct arena *arena = runner_arena(cost->runner);
    struct tried_chain chain = {.chain = name, .effects = effects};
    *list_add(&chain.programs, arena) = program;
    if (other != NULL)
        *list_add(&chain.programs, arena) = other;
    return chain;
}

/* Measures one more chain, which leaves out these effects; NULL after a message. */
static struct tried_chain *try_chain(struct cost *cost, struct tried_chain chain, uint64_t left_out)
{
    struct arena *arena = runner_arena(cost->runner);
    if (chain_trials_run(&cost->trials, &chain) != 0)
        return NULL;
    if (chain.beside != NULL)
        chain.us_per_frame = (1 - chain.saved) * chain.beside->us_per_frame;
    struct tried_chain *added = list_add(&cost->chains, arena);
    *added = chain;
    added->left_out = left_out;
    added->energy = relative_error_of(&added->lists, NULL);
    added->present = CHAIN_TRIALS_ENERGY;
    if (ideal(cost)->energy.low > 0) {
        added->relative_distance =
            relative_error_root(relative_error_of(&added->lists, &ideal(cost)->lists));
        added->present |= CHAIN_TRIALS_ERROR;
    }
    return added;
}

/* The whole chain but for these effects, if it is measured; else NULL. */
static const struct tried_chain *find_without(const struct cost *cost, uint64_t left_out)
{
    for (size_t i = 0; i < cost->chains.count; i++)
        if (cost->chains.items[i].automatic && cost->chains.items[i].left_out == left_out)
            return &cost->chains.items[i];
    return NULL;
}

/* The same, measured unless it already is. NULL after a message. */
static const struct tried_chain *try_without(struct cost *cost, uint64_t left_out)
{
    const struct tried_chain *known = find_without(cost, left_out);
    if (known != NULL)
        return known;
    struct arena *arena = runner_arena(cost->runner);
    const char *name =
        left_out == 0 ? cost->whole
                      : arena_format(arena, "%s, no %s", cost->whole, plan_names(left_out, arena));
    const char *effects = plan_request(cost->allowed & ~left_out, arena);
    struct tried_chain chain = chain_of(cost, name, effects, SENSOR, NOISE);
    chain.automatic = true;
    if (left_out != 0 && cost->bounded)
        chain.beside = whole(cost);
    return try_chain(cost, chain, left_out);
}

/* The effects at home in ideal, the only ones of which ideal echoes know. */
static uint64_t of_ideal(void)
{
    uint64_t effects = 0;
    for (int i = 0; i < EFFECT_COUNT; i++)
        if (effect_table[i]->home == EFFECT_HOME_IDEAL)
            effects |= EFFECT_BIT(i);
    return effects;
}

/* Runs the chains that every table has, and those that leave out one effect. */
static int try_all(struct cost *cost)
{
    struct arena *arena = runner_arena(cost->runner);
    const char *paper = plan_request(PAPER, arena), *all = plan_request(cost->allowed, arena);
    if (try_chain(cost,
                  chain_of(cost, "perfect", paper, "glint-sensor-perfect", "glint-noise-none"),
                  cost->needed & ~(PAPER & of_ideal())) == NULL ||
        try_chain(cost, chain_of(cost, "paper", paper, SENSOR, NOISE), cost->needed & ~PAPER) ==
            NULL ||
        try_without(cost, 0) == NULL)
        return -1;
    for (int i = 0; i < EFFECT_COUNT && !cost->brief; i++)
        if ((cost->needed & EFFECT_BIT(i)) != 0 && try_without(cost, EFFECT_BIT(i)) == NULL)
            return -1;
    return try_chain(cost, chain_of(cost, "smear", all, "glint-sensor-smear", NOISE), 0) != NULL
               ? 0
               : -1;
}

/* Counts the reference, the chains that every table has, and those that leave out one effect. */
static size_t expected_chains(const struct cost *cost)
{
    size_t count = 5;
    for (uint64_t left = cost->brief ? 0 : cost->needed; left != 0; left &= left - 1)
        count++;
    return count;
}

/* The error of spoiled lists of the reference (chain_trials_spoiled). */
static double spoiled(const struct cost *cost, double lost, double off_cells)
{
    double energy = chain_trials_spoiled(&cost->trials, lost, off_cells);
    return sqrt(elementary_max(energy, 0) / ideal(cost)->energy.value);
}

int cost_measure(struct cost *cost)
{
    bool signal = cost->reference == COST_SIGNAL;
    struct tried_chain reference =
        chain_of(cost, "signal", REFERENCE, signal ? SIGNAL : SENSOR, signal ? NULL : NOISE);
    cost->trials = (struct chain_trials){.runner = cost->runner,
                                         .sample = &cost->sample,
                                         .sensors = cost->suite,
                                         .expected = expected_chains(cost)};
    if (chain_trials_begin(&cost->trials, &reference) != 0 || try_all(cost) != 0)
        return -1;
    if (signal)
        *list_add(&cost->chains, runner_arena(cost->runner)) = reference;
    cost->frames = (int64_t)cost->sample.list.count;
    cost->seen_frames = cost->sample.seen;
    cost->scenes = (int64_t)cost->trials.scenes;
    cost->seeds = CHAIN_TRIALS_SEEDS;
    if ((ideal(cost)->present & CHAIN_TRIALS_ERROR) != 0)
        cost->scale =
            (struct cost_scale){spoiled(cost, 0.3, 0), spoiled(cost, 0.5, 0), spoiled(cost, 0, 1)};
    return 0;
}

struct relative_error cost_added(const struct cost *cost, const struct tried_chain *chain)
{
    return relative_error_added(&chain->lists, &whole(cost)->lists, &ideal(cost)->lists,
                                runner_arena(cost->runner));
}

/* An effect that may be left out, and the squared error added for the time saved if it is. */
struct saving {
    uint64_t effect;
    double price;
};

struct savings {
    LIST_OF(struct saving) list;
};

static int cheaper(const void *left, const void *right)
{
    double a = ((const struct saving *)left)->price, b = ((const struct saving *)right)->price;
    return (a > b) - (a < b);
}

/* False if the chain leaves out effects and is not faster than the whole chain with every seed. By
 * chance 1 of 64 effects that save nothing passes this sign test. */
static bool saves_time(const struct tried_chain *chain)
{
    return !chain->automatic || chain->left_out == 0 || chain->saved_least > 0;
}

/* The effects that save time with every seed, in the order of their prices. */
static struct savings savings_of(const struct cost *cost)
{
    struct arena *arena = runner_arena(cost->runner);
    struct savings savings = {0};
    for (size_t i = 0; i < cost->chains.count; i++) {
        const struct tried_chain *chain = &cost->chains.items[i];
        if (chain->automatic && chain->left_out != 0 && saves_time(chain))
            *list_add(&savings.list, arena) = (struct saving){
                chain->left_out, elementary_max(cost_added(cost, chain).value, 0) / chain->saved};
    }
    sort_list(&savings.list, cheaper, arena);
    return savings;
}

/* Draws its lists from the law of the reference. */
static bool is_reference(const struct cost *cost, const struct tried_chain *chain)
{
    if (cost->reference == COST_SIGNAL)
        return (chain->present & CHAIN_TRIALS_ENERGY) == 0;
    return chain == whole(cost) && strcmp(chain->effects, REFERENCE) == 0;
}

/* The figure that must be at most the bound, and the figure that must be least among such chains.
 * Energies of other chains may be negative, so the reference's counts as minus infinity. */
static double bounded(const struct tried_chain *chain, enum cost_bound bound)
{
    return bound == COST_BOUND_US ? chain->us_per_frame : chain->relative_distance.high;
}

static double rival(const struct cost *cost, const struct tried_chain *chain, enum cost_bound bound)
{
    if (bound == COST_BOUND_ERROR)
        return chain->us_per_frame;
    return is_reference(cost, chain) ? -(double)INFINITY : chain->energy.value;
}

/* Measures chains without more and more effects. For a time they stay out, until the chain is fast
 * enough; for an error each stays out only if the bound still holds. */
static int try_fewer_effects(struct cost *cost, enum cost_bound bound, double most)
{
    struct savings savings = savings_of(cost);
    uint64_t left_out = 0;
    cost->trials.expected += savings.list.count;
    for (size_t i = 0; i < savings.list.count; i++) {
        const struct tried_chain *chain =
            try_without(cost, left_out | savings.list.items[i].effect);
        if (chain == NULL)
            return -1;
        bool holds = bounded(chain, bound) <= most;
        if (holds && bound == COST_BOUND_US)
            return 0;
        if (holds || bound == COST_BOUND_US)
            left_out = chain->left_out;
    }
    return 0;
}

const struct tried_chain *cost_find(struct cost *cost, enum cost_bound bound, double most)
{
    struct diag *diag = runner_diag(cost->runner);
    if ((ideal(cost)->present & CHAIN_TRIALS_ERROR) == 0) {
        diag_fail(diag, DIAG_DATA,
                  "ideal echoes cannot be told from the reference in these frames (D %.3g, 95 %% "
                  "interval %.3g to %.3g), so chains have no errors",
                  ideal(cost)->energy.value, ideal(cost)->energy.low, ideal(cost)->energy.high);
        return NULL;
    }
    if (bounded(whole(cost), bound) > most || bound == COST_BOUND_ERROR)
        if (try_fewer_effects(cost, bound, most) != 0)
            return NULL;
    const struct tried_chain *best = NULL, *nearest = ideal(cost);
    for (size_t i = 0; i < cost->chains.count; i++) {
        const struct tried_chain *chain = &cost->chains.items[i];
        if (!saves_time(chain))
            continue;
        if (bounded(chain, bound) < bounded(nearest, bound))
            nearest = chain;
        if (bounded(chain, bound) <= most &&
            (best == NULL || rival(cost, chain, bound) < rival(cost, best, bound)))
            best = chain;
    }
    if (best == NULL)
        diag_fail(diag, DIAG_DATA,
                  "no chain holds the bound; the nearest, %s, takes %.1f us a frame and has an "
                  "error of up to %.1f %%",
                  nearest->chain, nearest->us_per_frame, 100 * nearest->relative_distance.high);
    else
        cost->chosen = best->chain;
    return best;
}

static void write_head(const struct cost *cost, const char *mark, struct text *text)
{
    text_format(text,
                "%s%" PRId64 " of %" PRId64 " frames of %" PRId64 " scene%s, seen by %s, with %d "
                "seeds.\n",
                mark, cost->frames, cost->seen_frames, cost->scenes, cost->scenes == 1 ? "" : "s",
                cost->suite, CHAIN_TRIALS_SEEDS);
    text_format(text,
                "%sErrors are distances from %s, in %% of those of ideal echoes (roots of energy "
                "distances).\n%sTheir 95 %% intervals hold for these frames under other seeds, not "
                "for other scenes.\n",
                mark, cost->reference == COST_SIGNAL ? "the signal" : "all effects of the suite",
                mark);
    if ((ideal(cost)->present & CHAIN_TRIALS_ERROR) != 0)
        text_format(text,
                    "%sFor scale: losing 30 %% of all targets gives %.0f %%, losing half of them "
                    "%.0f %%, moving all ranges by a cell %.0f %%.\n",
                    mark, 100 * cost->scale.lost_30_percent, 100 * cost->scale.lost_half,
                    100 * cost->scale.one_cell_off);
}

enum { CELL = 32 };

/* "3.1 %", or "<3.1 %" with the upper end of an interval that reaches 0. */
static const char *error_cell(struct relative_error root, char cell[CELL])
{
    if (root.low > 0)
        snprintf(cell, CELL, "%.1f %%", 100 * root.value);
    else
        snprintf(cell, CELL, "<%.1f %%", 100 * root.high);
    return cell;
}

static void write_chain(const struct tried_chain *chain, int width, struct text *text)
{
    text_format(text, "%-*s %11.1f", width, chain->chain, chain->us_per_frame);
    struct relative_error root = chain->relative_distance;
    char cell[CELL];
    if ((chain->present & CHAIN_TRIALS_ERROR) != 0)
        text_format(text, " %9s %8.1f to %5.1f", error_cell(root, cell), 100 * root.low,
                    100 * root.high);
    else
        text_format(text, " %9s %17s",
                    (chain->present & CHAIN_TRIALS_ENERGY) != 0 ? "-" : "reference", "");
    text_format(text, " %8.2f\n", chain->targets_per_scan);
}

void cost_write_table(const struct cost *cost, struct text *text)
{
    write_head(cost, "", text);
    if ((ideal(cost)->present & CHAIN_TRIALS_ERROR) == 0)
        text_format(text,
                    "There are none: ideal echoes cannot be told from the reference (D %.3g, %.3g "
                    "to %.3g).\n",
                    ideal(cost)->energy.value, ideal(cost)->energy.low, ideal(cost)->energy.high);
    int width = 28;
    for (size_t i = 0; i < cost->chains.count; i++)
        if ((int)strlen(cost->chains.items[i].chain) > width)
            width = (int)strlen(cost->chains.items[i].chain);
    text_format(text, "\n%-*s %11s %9s %17s %8s\n", width, "chain", "us a frame", "error",
                "interval", "targets");
    for (size_t i = 0; i < cost->chains.count; i++)
        write_chain(&cost->chains.items[i], width, text);
    if (cost->no_signal != NULL)
        text_format(text, "%-*s left out: %s\n", width, "signal", cost->no_signal);
}

/* In per cent, rounded to one digit after the point; never -0. */
static double percent(double share)
{
    return rint(1000 * share) / 10 + 0.0;
}

static void write_left_out(const struct cost *cost, int effect, struct text *text)
{
    const struct tried_chain *chain = find_without(cost, EFFECT_BIT(effect));
    if (chain == NULL)
        return;
    struct relative_error added = cost_added(cost, chain);
    text_format(text, "# %-17s off: saves %.1f us, adds %.1f (%.1f to %.1f)\n",
                effects_names[effect], whole(cost)->us_per_frame - chain->us_per_frame,
                percent(added.value), percent(added.low), percent(added.high));
}

void cost_write_pipeline(const struct cost *cost, const struct tried_chain *chain,
                         struct text *text)
{
    write_head(cost, "# ", text);
    text_format(text, "# This takes %.1f us a frame instead of %.1f, with an error of ",
                chain->us_per_frame, whole(cost)->us_per_frame);
    struct relative_error root = chain->relative_distance;
    char cell[CELL];
    if ((chain->present & CHAIN_TRIALS_ERROR) != 0)
        text_format(text, "%s (%.1f to %.1f).\n", error_cell(root, cell), 100 * root.low,
                    100 * root.high);
    else
        text_add_word(text, "0 by definition.\n");
    if (chain->left_out != 0)
        text_add_word(text,
                      "# If one effect alone is off, the squared error grows by these points; an "
                      "error of 10 % is 1 point.\n");
    for (int i = 0; i < EFFECT_COUNT; i++)
        if ((chain->left_out & EFFECT_BIT(i)) != 0)
            write_left_out(cost, i, text);
    plan_write_pipeline(cost->suite, chain->effects, chain->programs.items, chain->programs.count,
                        text);
}
