#include "run/cost_table.h"

#include <inttypes.h>
#include <stdio.h>

#include "base/elementary.h"
#include "effects/effect.h"
#include "text/document.h"
#include "text/text_table.h"

const char *const cost_table_references[] = {"signal", "all", NULL};

static const struct field interval_fields[] = {
    {FIELD_REAL_IN(struct relative_error, value, -1e300, 1e300, "the figure")},
    {FIELD_REAL_IN(struct relative_error, low, -1e300, 1e300, "of its 95 % interval")},
    {FIELD_REAL_IN(struct relative_error, high, -1e300, 1e300, "of its 95 % interval")},
    {0},
};

static const struct record interval_record = {FIELD_TABLE(
    struct relative_error, interval_fields, "interval", "A figure with its 95 % interval.")};

static const struct field chain_fields[] = {
    {FIELD_NAME_OF(struct cost_chain, chain, "its name in the table")},
    {FIELD_NAME_OF(struct cost_chain, effects, "for glint-ideal --effects")},
    {FIELD_NAMES_OF(struct cost_chain, programs, "those after glint-ideal")},
    {FIELD_REAL_IN(struct cost_chain, us_per_frame, 0, 1e300,
                   "CPU time of a frame here, with reading and writing its line: the median of "
                   "rounds")},
    {FIELD_REAL_IN(struct cost_chain, targets_per_scan, 0, 1e300, "mean number in a list")},
    {OPTIONAL_RECORD(struct cost_chain, energy, &interval_record,
                     "energy distance from the reference, absent for itself"),
     .group = COST_ENERGY},
    {OPTIONAL_RECORD(struct cost_chain, relative_distance, &interval_record,
                     "the error: root of energy over that of ideal echoes, 0 if energy is not "
                     "above 0; absent if ideal echoes cannot be told from the reference"),
     .group = COST_ERROR},
    {0},
};

static const struct record chain_record = {
    FIELD_TABLE(struct cost_chain, chain_fields, "cost_chain", "A chain, as it was measured."),
    .present_offset = offsetof(struct cost_chain, present)};

static const struct field time_fields[] = {
    {FIELD_REAL_IN(struct trial_time, us, -1e300, 1e300, "the median over rounds")},
    {FIELD_REAL_IN(struct trial_time, least_us, -1e300, 1e300, "of a round")},
    {FIELD_REAL_IN(struct trial_time, most_us, -1e300, 1e300, "of a round")},
    {0},
};

static const struct record time_record = {
    FIELD_TABLE(struct trial_time, time_fields, "time", "A time, over several rounds.")};

static const struct field effect_fields[] = {
    {FIELD_CHOICE_OF(struct cost_effect, effect, effects_names, "that is left out alone")},
    {FIELD_INTEGER_IN(struct cost_effect, lists_changed, 0, 0x1p53,
                      "that are not the same bytes without it")},
    {FIELD_RECORD_OF(struct cost_effect, saved, &time_record, "of a frame's CPU time")},
    {OPTIONAL_RECORD(struct cost_effect, squared_error_added, &interval_record,
                     "squared error of the chain without it less that of the whole chain"),
     .group = COST_ERROR},
    {FIELD_NAME_OF(struct cost_effect, called_for_by,
                   "what of the scene calls for it in most lists, or the members of documents")},
    {OPTIONAL_INTEGER(struct cost_effect, lists_called, 0, 0x1p53,
                      "lists in which that of the scene does; absent: documents alone tell")},
    {0},
};

static const struct record effect_record = {
    FIELD_TABLE(struct cost_effect, effect_fields, "cost_effect",
                "What leaving out one effect alone does."),
    .present_offset = offsetof(struct cost_effect, present)};

static const struct field scale_fields[] = {
    {FIELD_REAL_IN(struct cost_scale, lost_30_percent, 0, 1e300, "30 % of all targets lost")},
    {FIELD_REAL_IN(struct cost_scale, lost_half, 0, 1e300, "half of all targets lost")},
    {FIELD_REAL_IN(struct cost_scale, one_cell_off, 0, 1e300, "all ranges moved by one cell")},
    {0},
};

static const struct record scale_record = {
    FIELD_TABLE(struct cost_scale, scale_fields, "cost_scale",
                "Errors of spoiled lists of the reference; 0 where chains have no errors.")};

static const struct field table_fields[] = {
    {FIELD_NAME_OF(struct cost_table, suite, "as --sensors names it")},
    {OPTIONAL_NAME(
        struct cost_table, vehicles,
        "set of documents that objects were extracted with; absent: paper, or the frames "
        "had reflectors")},
    {OPTIONAL_CHOICE(struct cost_table, reference, cost_table_references,
                     "what errors are from; it has seeds of its own; absent: there are none"),
     .absent = -1},
    {FIELD_INTEGER_IN(struct cost_table, frames, 0, 0x1p53, "of the sample")},
    {FIELD_INTEGER_IN(struct cost_table, seen_frames, 0, 0x1p53, "of the stream")},
    {FIELD_INTEGER_IN(struct cost_table, timed_frames, 0, 0x1p53,
                      "of the sample, in which times were measured")},
    {FIELD_INTEGER_IN(struct cost_table, scenes, 0, 0x1p53, "of the sample")},
    {FIELD_INTEGER_IN(struct cost_table, seeds, 0, 0x1p53,
                      "of every chain; the intervals hold for these frames under other seeds")},
    {FIELD_INTEGER_IN(struct cost_table, lists, 0, 0x1p53,
                      "of targets, of which lists_changed is a part: scans of a sensor")},
    {FIELD_RECORD_OF(struct cost_table, scale, &scale_record, "to compare errors with")},
    {OPTIONAL_NAME(struct cost_table, chosen, "the chain that was found for a bound")},
    {FIELD_LIST_OF(struct cost_table, chains, &chain_record, "in the order of the text")},
    {FIELD_LIST_OF(struct cost_table, effects, &effect_record,
                   "that the frames call for, in the order of the chain")},
    {0},
};

const struct record cost_table_record = {
    FIELD_TABLE(struct cost_table, table_fields, "cost",
                "What glint-plan and glint-cost write with --json: chains and effects.")};

void cost_table_chain(struct cost_chain *chain, const struct trial *trial, struct trial_time whole,
                      struct trial_time saved, bool part, struct arena *arena)
{
    chain->effects = trial->effects;
    chain->programs.count = 0;
    for (int i = 0; i < 2 && trial->programs[i] != NULL; i++)
        *list_add(&chain->programs, arena) = trial->programs[i];
    chain->us_per_frame = whole.us - saved.us;
    chain->us_least = whole.us - saved.most_us;
    chain->us_most = whole.us - saved.least_us;
    chain->close = part && saved.least_us <= 0 && saved.most_us >= whole.least_us - whole.most_us;
    if (chain->close)
        chain->us_per_frame = elementary_min(chain->us_per_frame, whole.us);
}

void cost_table_whole(struct cost_chain *chain, const struct trial *trial, struct trial_time time,
                      struct arena *arena)
{
    cost_table_chain(chain, trial, time, (struct trial_time){0}, false, arena);
    chain->us_least = time.least_us;
    chain->us_most = time.most_us;
}

struct cost_effect cost_table_effect(const struct trial_bench *bench, enum effect_id effect)
{
    const struct trial *trial = &bench->without[effect];
    struct cost_effect row = {
        .effect = effect, .lists_changed = trial->changed, .saved = trial_saved(bench, trial)};
    row.called_for_by = trial_cause(trial, &row.lists_called);
    return row;
}

enum { CELL = 48 };

/* "3.1 %", "0.0 %", or "<3.1 %" with the upper end of an interval that reaches 0. */
static const char *error_cell(struct relative_error root, char cell[CELL])
{
    if (root.low > 0 || root.high == 0)
        snprintf(cell, CELL, "%.1f %%", 100 * root.value);
    else
        snprintf(cell, CELL, "<%.1f %%", 100 * root.high);
    return cell;
}

static void add_chain(const struct cost_chain *chain, struct text *rows)
{
    char cell[CELL];
    struct relative_error root = chain->relative_distance;
    text_format(rows, "%s\t%s%.1f", chain->chain, chain->close ? "~" : "", chain->us_per_frame);
    if ((chain->present & COST_ERROR) != 0)
        text_format(rows, "\t%s\t%.1f to %5.1f", error_cell(root, cell), 100 * root.low,
                    100 * root.high);
    else
        text_format(rows, "\t%s\t", (chain->present & COST_ENERGY) != 0 ? "-" : "reference");
    text_format(rows, "\t%.2f\n", chain->targets_per_scan);
}

static void write_chains(const struct cost_table *table, const char *mark, struct text *text)
{
    struct text rows = {0};
    text_add_word(&rows, "chain\tus a frame\terror\tinterval\ttargets\n");
    for (size_t i = 0; i < table->chains.count; i++)
        add_chain(&table->chains.items[i], &rows);
    text_table_write(&rows, (int[]){-27, 10, 9, 16, 7, 0}, mark, text);
    if (table->no_signal != NULL)
        text_format(text, "%s%-27s  left out: %s\n", mark, "signal", table->no_signal);
}

/* A part with one digit after the point; never -0. */
static double tenths(double value)
{
    return rint(10 * value) / 10 + 0.0;
}

/* "7.5", or "<0.4" with the most of all rounds if it is above 0 in some and not in others. */
static void add_saved(const struct cost_effect *effect, double unit, const char *ending,
                      struct text *rows)
{
    bool told = effect->saved.least_us > 0 || effect->saved.most_us < 0;
    double value = told ? effect->saved.us : effect->saved.most_us;
    double shown = told ? tenths(value / unit) : ceil(10 * value / unit) / 10 + 0.0;
    text_format(rows, "\t%s%.1f%s", told ? "" : "<", shown, ending);
}

static void add_effect(const struct cost_table *table, const struct cost_effect *effect,
                       double whole_us, struct text *rows)
{
    text_format(rows, "%s\t%" PRId64 " of %" PRId64, effects_names[effect->effect],
                effect->lists_changed, table->lists);
    add_saved(effect, 1, "", rows);
    add_saved(effect, whole_us / 100, " %", rows);
    struct relative_error added = effect->squared_error_added;
    if ((effect->present & COST_ERROR) != 0)
        text_format(rows, "\t%.1f\t%.1f to %5.1f", tenths(100 * added.value),
                    tenths(100 * added.low), tenths(100 * added.high));
    else if (table->reference >= 0)
        text_add_word(rows, "\t\t");
    text_format(rows, "\t%s", effect->called_for_by);
    if (effect->lists_called > 0 && effect->lists_called < effect->lists_changed)
        text_format(rows, ", in %" PRId64, effect->lists_called);
    text_add_word(rows, "\n");
}

static void write_effects(const struct cost_table *table, const char *mark, uint64_t shown,
                          struct text *text)
{
    int widths[] = {-17, 14, 8, 8, -1, 0};
    int widths_with_errors[] = {-17, 14, 8, 8, 6, 15, -1, 0};
    double whole_us = table->chains.items[table->whole].us_per_frame;
    bool errors = table->reference >= 0;
    struct text rows = {0};
    text_format(&rows, "effect left out\tlists changed\tus saved\tof time%s\tcalled for by\n",
                errors ? "\tadded\tinterval" : "");
    for (size_t i = 0; i < table->effects.count; i++) {
        const struct cost_effect *effect = &table->effects.items[i];
        if ((shown & EFFECT_BIT(effect->effect)) != 0)
            add_effect(table, effect, whole_us, &rows);
    }
    text_table_write(&rows, errors ? widths_with_errors : widths, mark, text);
}

void cost_table_write(const struct cost_table *table, const char *mark, uint64_t shown,
                      struct text *text)
{
    const struct cost_chain *whole = &table->chains.items[table->whole];
    text_format(
        text,
        "%sTimes are medians of %d rounds over %" PRId64 " frames; those of %s lie %.1f %% "
        "apart.\n%sA time saved with < may be 0; below 0 it is time lost. A chain with ~ may "
        "take as long as that.\n",
        mark, TRIAL_ROUNDS, table->timed_frames, whole->chain,
        100 * (whole->us_most - whole->us_least) / whole->us_per_frame, mark);
    text_format(text, "%.1s\n", mark);
    write_chains(table, mark, text);
    if (table->effects.count == 0 || shown == 0)
        return;
    text_format(text, "%.1s\n", mark);
    write_effects(table, mark, shown, text);
}

void cost_table_take_vehicles(struct cost_table *table, const struct trial_bench *bench)
{
    bool others = bench->vehicles != NULL && strcmp(bench->vehicles, "paper") != 0;
    table->vehicles = others && bench->extracts ? bench->vehicles : NULL;
}

void cost_table_write_scenes(const struct cost_table *table, struct text *text)
{
    text_format(text, "%" PRId64 " scene%s", table->scenes, table->scenes == 1 ? "" : "s");
    if (table->vehicles != NULL)
        text_format(text, " with the vehicles of %s", table->vehicles);
    text_format(text, ", seen by %s", table->suite);
}

/* Writes the word so that bash and glint read it back as it is, in quotes if need be. */
static void write_word(const char *word, struct text *text)
{
    static const char plain[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-";
    if (word[strspn(word, plain)] == '\0') {
        text_add_word(text, word);
        return;
    }
    text_add_word(text, "'");
    for (; *word != '\0'; word++)
        text_add(text, *word == '\'' ? "'\\''" : word, *word == '\'' ? 4 : 1);
    text_add_word(text, "'");
}

void cost_table_write_pipeline(const struct cost_table *table, const struct cost_chain *chain,
                               const struct cost_chain *whole, struct text *text)
{
    const char *sensors = table->suite;
    struct relative_error root = chain->relative_distance;
    char cell[CELL];
    text_format(
        text, "# This takes %.1f us a frame instead of %.1f, with an error of %s (%.1f to %.1f).\n",
        chain->us_per_frame, whole->us_per_frame, error_cell(root, cell), 100 * root.low,
        100 * root.high);
    text_add_word(text, "set -o pipefail\nglint-extract");
    if (table->vehicles != NULL) {
        text_add_word(text, " --vehicles ");
        write_word(table->vehicles, text);
    }
    text_add_word(text, " \\\n  | glint-ideal --sensors ");
    write_word(sensors, text);
    text_format(text, " --effects %s", chain->effects);
    for (size_t i = 0; i < chain->programs.count; i++) {
        text_format(text, " \\\n  | %s", chain->programs.items[i]);
        if (!document_is_plain(sensors)) {
            text_add_word(text, " --sensors ");
            write_word(sensors, text);
        }
    }
    text_add_word(text, "\n");
}
