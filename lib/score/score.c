#include "score/score.h"

#include <assert.h>
#include <inttypes.h>
#include <stdio.h>

#include "base/elementary.h"
#include "base/sort.h"
#include "base/units.h"
#include "frame/frame_order.h"
#include "score/gospa.h"
#include "text/text_table.h"

#define COUNT(owner, member, help) FIELD_INTEGER_IN(owner, member, 0, 0x1p53, help)
#define MEASURE(member, help) OPTIONAL_REAL(struct score, member, 0, 1e300, help)
#define MEAN(member, help) MEASURE(member, help), .group = SCORE_SCANS
#define DIFFERENCE(member, low, bit, help)                                                         \
    FIELD_REAL_IN(struct score_differences, member, low, 1e300, help), FIELD_OPTIONAL,             \
        .group = (bit)

static const struct field differences_fields[] = {
    {DIFFERENCE(mean, -1e300, SCORE_PAIRS, "mean of the pairs' differences, listed less true")},
    {DIFFERENCE(rms, 0, SCORE_PAIRS, "root mean square of the pairs' differences")},
    {DIFFERENCE(p95, 0, SCORE_PAIRS, "size that 95 % of the pairs' differences do not exceed")},
    {DIFFERENCE(max, 0, SCORE_PAIRS, "size of the largest of the pairs' differences")},
    {DIFFERENCE(wasserstein, 0, SCORE_LISTS, "Wasserstein-1 distance of the two lists, unpaired")},
    {0},
};

static const struct record differences_record = {
    FIELD_TABLE(struct score_differences, differences_fields, "differences",
                "In the component's unit; absent where there are no pairs, or a list is empty."),
    .present_offset = offsetof(struct score_differences, present)};

#define COMPONENT(name_, which, help_)                                                             \
    FIELD_NAMED(name_), .kind = FIELD_RECORD, .optional = true, .record = &differences_record,     \
                        .offset = offsetof(struct score, differences) +                            \
                                  (which) * sizeof(struct score_differences),                      \
                        .help = (help_)

static const struct field score_fields[] = {
    {OPTIONAL_NAME(struct score, sensor, "name of the sensor; absent: all sensors")},
    {COUNT(struct score, scans,
           "pairs of lists: of one sensor in one frame, or the tracks of one frame")},
    {COUNT(struct score, true_scans,
           "scans of the truth alone, which are not compared; absent: none"),
     FIELD_OPTIONAL},
    {COUNT(struct score, listed_scans,
           "scans of the scored stream alone, which are not compared; absent: none"),
     FIELD_OPTIONAL},
    {COUNT(struct score, true_count, "items of the true lists")},
    {COUNT(struct score, listed_count, "items of the scored lists")},
    {COUNT(struct score, pair_count, "pairs closer than the cut-off")},
    {COUNT(struct score, missed_count, "true items without a pair")},
    {COUNT(struct score, false_count, "scored items without a pair")},
    {MEAN(gospa, "mean GOSPA over the scans")},
    {MEAN(gospa_rms,
          "root mean square of GOSPA over the scans; its square is the sum of the parts")},
    {MEAN(gospa_max, "largest GOSPA of a scan")},
    {MEAN(gospa_localisation, "part of the pairs' squared distances, mean over the scans")},
    {MEAN(gospa_missed,
          "part of missed items, half the squared cut-off each, mean over the scans")},
    {MEAN(gospa_false, "part of false items, half the squared cut-off each, mean over the scans")},
    {MEAN(ospa, "mean OSPA over the scans")},
    {COMPONENT(range_m, SCORE_RANGE, "differences in range")},
    {COMPONENT(azimuth_rad, SCORE_AZIMUTH, "differences in azimuth")},
    {COMPONENT(range_rate_mps, SCORE_RANGE_RATE, "differences in range rate")},
    {COMPONENT(amplitude_db, SCORE_AMPLITUDE, "differences in amplitude")},
    {COMPONENT(position_m, SCORE_POSITION, "distances of tracks and objects")},
    {COMPONENT(velocity_mps, SCORE_VELOCITY,
               "sizes of the differences in velocity of tracks and objects")},
    {COMPONENT(
        nees, SCORE_NEES,
        "squared distances over the tracks' covariances; mean 2 if the covariances are right")},
    {MEASURE(
        nees_low,
        "lower end of 95 % of all means over as many independent pairs; absent below 5 pairs")},
    {MEASURE(nees_high, "upper end of these 95 %; absent below 5 pairs")},
    {0},
};

const struct record score_record = {
    FIELD_TABLE(
        struct score, score_fields, "score",
        "How lists differ from the truth; GOSPA and OSPA are in cells for targets, in metres for "
        "tracks, and absent without scans."),
    .present_offset = offsetof(struct score, present)};

#define LINE_HEAD                                                                                  \
    {FIELD_NAME_OF(struct score_line, scene, "scene of the frame")},                               \
        {COUNT(struct score_line, frame, "number of the frame in its scene")},                     \
    {                                                                                              \
        FIELD_REAL_IN(struct score_line, time_s, -1e10, 1e10, "time of the frame")                 \
    }
#define SWITCHES(owner)                                                                            \
    COUNT(owner, id_switches, "objects paired with another track than the last time")

static const struct field line_fields[] = {
    LINE_HEAD,
    {FIELD_LIST_OF(struct score_line, sensors, &score_record,
                   "scores of the sensors that measured, by name")},
    {0},
};

const struct record score_line_record = {FIELD_TABLE(struct score_line, line_fields, "score_line",
                                                     "Scores of one frame, by glint-score.")};

static const struct field summary_fields[] = {
    {COUNT(struct score_summary, frames, "frames of each stream")},
    {FIELD_REAL_IN(struct score_summary, cutoff, 0, 1e6, "cut-off distance, in cells")},
    {OPTIONAL_REAL(struct score_summary, azimuth_cell_rad, 0, 10,
                   "size of a cell in azimuth; absent: a twentieth of each field of view")},
    {FIELD_RECORD_OF(struct score_summary, all, &score_record, "score over all sensors")},
    {FIELD_LIST_OF(struct score_summary, sensors, &score_record,
                   "scores of the sensors that measured, by name")},
    {0},
};

const struct record score_summary_record = {
    FIELD_TABLE(struct score_summary, summary_fields, "score_summary",
                "Scores of a stream, by glint-score --summary.")};

static const struct field track_line_fields[] = {
    LINE_HEAD,
    {SWITCHES(struct score_line)},
    {FIELD_RECORD_OF(struct score_line, all, &score_record, "score over all tracks")},
    {0},
};

const struct record score_track_line_record = {
    FIELD_TABLE(struct score_line, track_line_fields, "score_track_line",
                "Score of one frame, by glint-score-tracks.")};

static const struct field track_summary_fields[] = {
    {COUNT(struct score_summary, frames, "frames of each stream")},
    {FIELD_REAL_IN(struct score_summary, cutoff_m, 0, 1e6,
                   "tracks this far off or farther are no pair")},
    {SWITCHES(struct score_summary)},
    {FIELD_RECORD_OF(struct score_summary, all, &score_record, "score over all frames")},
    {OPTIONAL_RECORD(struct score_summary, difference, &tracker_difference_record,
                     "scores of --tracks less those of --against"),
     .group = SCORE_DIFFERENCE},
    {0},
};

const struct record score_track_summary_record = {
    FIELD_TABLE(struct score_summary, track_summary_fields, "score_track_summary",
                "Score of a stream, by glint-score-tracks --summary."),
    .present_offset = offsetof(struct score_summary, present)};

static void append(struct score_values *values, const struct score_values *more,
                   struct arena *arena)
{
    for (size_t i = 0; i < more->list.count; i++)
        *list_add(&values->list, arena) = more->list.items[i];
}

/* Adds counts and sums, but no values. */
static void add_sums(struct score_tally *tally, const struct score_tally *other)
{
    tally->scans += other->scans;
    tally->true_scans += other->true_scans;
    tally->listed_scans += other->listed_scans;
    tally->truths += other->truths;
    tally->listed += other->listed;
    tally->pairs += other->pairs;
    tally->gospa_sum += other->gospa_sum;
    tally->gospa_max = elementary_max(tally->gospa_max, other->gospa_max);
    tally->localisation += other->localisation;
    tally->missed_part += other->missed_part;
    tally->false_part += other->false_part;
    tally->ospa_sum += other->ospa_sum;
}

void score_add_scan(struct score_tally *tally, double squares, size_t pairs, size_t truths,
                    size_t listed, double cutoff)
{
    struct gospa gospa = gospa_of(squares, pairs, truths, listed, cutoff);
    add_sums(tally, &(struct score_tally){
                        .scans = 1,
                        .truths = (int64_t)truths,
                        .listed = (int64_t)listed,
                        .pairs = (int64_t)pairs,
                        .gospa_sum = gospa.value,
                        .gospa_max = gospa.value,
                        .localisation = gospa.localisation,
                        .missed_part = gospa.missed_part,
                        .false_part = gospa.false_part,
                        .ospa_sum = gospa.ospa,
                    });
}

void score_merge(struct score_tally *tally, const struct score_tally *other, struct arena *arena)
{
    add_sums(tally, other);
    for (int kind = 0; kind < SCORE_KINDS; kind++)
        for (int i = 0; i < SCORE_COMPONENTS; i++)
            append(&tally->values[kind][i], &other->values[kind][i], arena);
}

/* Sums over the sorted values, so that the order of the differences changes no bit. */
struct score_differences score_statistics(double *differences, size_t count, struct arena *arena)
{
    assert(count > 0);
    double sum = 0, squares = 0;
    double *size = differences;
    sort_numbers(differences, count, arena);
    for (size_t i = 0; i < count; i++) {
        sum += differences[i];
        squares += differences[i] * differences[i];
        size[i] = fabs(differences[i]);
    }
    sort_numbers(size, count, arena);
    return (struct score_differences){
        .mean = sum / (double)count,
        .rms = sqrt(squares / (double)count),
        .p95 = size[(19 * count + 19) / 20 - 1],
        .max = size[count - 1],
        .present = SCORE_PAIRS,
    };
}

double score_wasserstein(double *one, size_t one_count, double *other, size_t other_count,
                         struct arena *arena)
{
    assert(one_count > 0 && other_count > 0);
    sort_numbers(one, one_count, arena);
    sort_numbers(other, other_count, arena);
    double area = 0, from = elementary_min(one[0], other[0]);
    size_t i = 0, j = 0; /* number of values of each that are at most `from` */
    while (i < one_count || j < other_count) {
        bool first = j == other_count || (i < one_count && one[i] <= other[j]);
        double to = first ? one[i] : other[j];
        double apart = fabs((double)(i * other_count) - (double)(j * one_count));
        area += apart * (to - from);
        from = to;
        *(first ? &i : &j) += 1;
    }
    return area / ((double)one_count * (double)other_count);
}

/* The values of one kind of all tallies, in one list allocated at their number. */
static struct score_values gather(const struct score_tally *tallies, size_t count, int kind,
                                  int component, struct arena *arena)
{
    struct score_values all = {0};
    for (size_t i = 0; i < count; i++)
        all.list.room += tallies[i].values[kind][component].list.count;
    all.list.items = arena_get(arena, all.list.room * sizeof *all.list.items);
    for (size_t i = 0; i < count; i++)
        append(&all, &tallies[i].values[kind][component], arena);
    return all;
}

static struct score_differences differences_of(const struct score_tally *tallies, size_t count,
                                               int component, struct arena *arena)
{
    struct score_values errors = gather(tallies, count, SCORE_ERROR, component, arena);
    struct score_values truth = gather(tallies, count, SCORE_TRUTH, component, arena);
    struct score_values listed = gather(tallies, count, SCORE_LISTED, component, arena);
    struct score_differences differences = {0};
    if (errors.list.count > 0)
        differences = score_statistics(errors.list.items, errors.list.count, arena);
    if (truth.list.count > 0 && listed.list.count > 0) {
        differences.wasserstein = score_wasserstein(truth.list.items, truth.list.count,
                                                    listed.list.items, listed.list.count, arena);
        differences.present |= SCORE_LISTS;
    }
    return differences;
}

/* The quantile of the mean of count NEES in a plane at z normal deviations: chi squared with 2
 * count degrees of freedom, divided by count (Wilson and Hilferty 1931; off by less than 1 % from
 * count 5 on). */
enum { FEWEST_COVERED = 5 };

static double nees_bound(double count, double z)
{
    double root = 1 - 1 / (9 * count) + z / (3 * sqrt(count));
    return 2 * root * root * root;
}

struct score score_of(const struct score_tally *tallies, size_t count, struct arena *arena)
{
    struct score_tally all = {0};
    size_t covered = 0;
    for (size_t i = 0; i < count; i++)
        add_sums(&all, &tallies[i]);
    double scans = all.scans > 0 ? (double)all.scans : 1;
    struct score score = {
        .sensor = count > 0 ? tallies->sensor : NULL,
        .scans = all.scans,
        .true_scans = all.true_scans,
        .listed_scans = all.listed_scans,
        .present = all.scans > 0 ? SCORE_SCANS : 0,
        .true_count = all.truths,
        .listed_count = all.listed,
        .pair_count = all.pairs,
        .missed_count = all.truths - all.pairs,
        .false_count = all.listed - all.pairs,
        .gospa = all.gospa_sum / scans,
        .gospa_max = all.gospa_max,
        .gospa_localisation = all.localisation / scans,
        .gospa_missed = all.missed_part / scans,
        .gospa_false = all.false_part / scans,
        .ospa = all.ospa_sum / scans,
    };
    score.gospa_rms = sqrt(score.gospa_localisation + score.gospa_missed + score.gospa_false);
    for (int i = 0; i < SCORE_COMPONENTS; i++)
        score.differences[i] = differences_of(tallies, count, i, arena);
    for (size_t i = 0; i < count; i++)
        covered += tallies[i].values[SCORE_ERROR][SCORE_NEES].list.count;
    if (covered >= FEWEST_COVERED) {
        score.nees_low = nees_bound((double)covered, -1.96);
        score.nees_high = nees_bound((double)covered, 1.96);
    }
    return score;
}

void score_merge_sensor(struct score_tallies *tallies, const struct score_tally *scan,
                        struct arena *arena)
{
    for (size_t i = 0; i < tallies->list.count; i++)
        if (strcmp(tallies->list.items[i].sensor, scan->sensor) == 0) {
            score_merge(&tallies->list.items[i], scan, arena);
            return;
        }
    struct score_tally *tally = list_add(&tallies->list, arena);
    tally->sensor = arena_text(arena, scan->sensor, strlen(scan->sensor));
    score_merge(tally, scan, arena);
}

_Static_assert(offsetof(struct score_tally, sensor) == 0, "frame_order_names compares it");

void score_summarize(struct score_tallies *tallies, struct score_summary *summary,
                     struct arena *arena)
{
    size_t count = tallies->list.count;
    struct arena scratch = {0};
    sort_list(&tallies->list, frame_order_names, arena);
    for (size_t i = 0; i < count; i++) {
        *list_add(&summary->sensors, arena) = score_of(&tallies->list.items[i], 1, &scratch);
        arena_clear(&scratch);
    }
    summary->all = score_of(tallies->list.items, count, &scratch);
    summary->all.sensor = NULL;
    arena_free(&scratch);
}

struct table {
    const struct score *scores;
    const char *const *heads;
    size_t count;
    const char *distance; /* the unit of GOSPA and OSPA, and that of the parts of its square */
    const char *square;
    double *row; /* a figure for each score; NAN: it has none */
    struct text *rows;
};

/* Figures that the decimals cannot tell from 0, and very large ones, have an exponent. */
static void add_figure(double value, int decimals, struct text *rows)
{
    double size = fabs(value);
    bool plain = size == 0 || decimals < 4 || (size >= 0.00005 && size < 1e6);
    if (isnan(value))
        text_add_word(rows, "\t-");
    else
        text_format(rows, plain ? "\t%.*f" : "\t%.*e", plain ? decimals : 3, value);
}

static void add_row(const struct table *table, const char *name, const char *unit, int decimals)
{
    bool any = false;
    for (size_t i = 0; i < table->count; i++)
        any = any || !isnan(table->row[i]);
    if (!any)
        return;
    text_format(table->rows, "%s\t%s", name, unit);
    for (size_t i = 0; i < table->count; i++)
        add_figure(table->row[i], decimals, table->rows);
    text_add_word(table->rows, "\n");
}

/* The figures of a field, of the score itself or of a record at this offset in it. */
static void fill_row(const struct table *table, const struct record *record,
                     const struct field *field, size_t offset, double scale)
{
    for (size_t i = 0; i < table->count; i++) {
        const char *base = (const char *)&table->scores[i] + offset;
        table->row[i] = (double)NAN;
        if (field_present(record, field, base))
            table->row[i] = field_number(field, base) * (field->kind == FIELD_REAL ? scale : 1);
    }
}

/* "azimuth rms" and all the others of the differences in a component, angles in degrees. */
static void add_component(const struct table *table, const struct field *component)
{
    const char *unit = field_unit(component->name);
    bool angle = strcmp(unit, "rad") == 0;
    const char *ending = strrchr(component->name, '_');
    int length =
        (int)(ending != NULL ? (size_t)(ending - component->name) : strlen(component->name));
    for (const struct field *field = component->record->fields; field->name != NULL; field++) {
        char name[80];
        snprintf(name, sizeof name, "%.*s %s", length, component->name, field->name);
        fill_row(table, component->record, field, component->offset, angle ? 180 / PI : 1);
        add_row(table, name, angle ? "deg" : unit, 4);
    }
}

static void add_rates(const struct table *table)
{
    const struct score *scores = table->scores;
    for (size_t i = 0; i < table->count; i++)
        table->row[i] = 100.0 * (double)scores[i].missed_count / (double)scores[i].true_count;
    add_row(table, "missed", "% of true", 1);
    for (size_t i = 0; i < table->count; i++)
        table->row[i] = 100.0 * (double)scores[i].false_count / (double)scores[i].listed_count;
    add_row(table, "false", "% of listed", 1);
}

static const char *unit_of(const struct table *table, const struct field *field)
{
    if (field->offset >= offsetof(struct score, gospa_localisation) &&
        field->offset <= offsetof(struct score, gospa_false))
        return table->square;
    return field->offset <= offsetof(struct score, ospa) ? table->distance : "";
}

static void write_table(const struct table *table, struct text *text)
{
    text_add_word(table->rows, "\tunit");
    for (size_t i = 0; i < table->count; i++)
        text_format(table->rows, "\t%s", table->heads[i]);
    text_add_word(table->rows, "\n");
    for (const struct field *field = score_record.fields; field->name != NULL; field++) {
        if (field->kind == FIELD_INTEGER || field->kind == FIELD_REAL)
            fill_row(table, &score_record, field, 0, 1);
        if (field->kind == FIELD_INTEGER)
            add_row(table, field->name, "", 0);
        else if (field->kind == FIELD_REAL)
            add_row(table, field->name, unit_of(table, field), 4);
        else if (field->kind == FIELD_RECORD)
            add_component(table, field);
        if (field->offset == offsetof(struct score, false_count))
            add_rates(table);
    }
    text_table_write(table->rows, (int[]){-22, -12, 10, 0}, "", text);
}

void score_table_summary(const struct score_summary *summary, struct text *text,
                         struct arena *arena)
{
    size_t sensors = summary->sensors.count;
    struct score *scores = arena_get(arena, (sensors + 1) * sizeof *scores);
    const char **heads = arena_get(arena, (sensors + 1) * sizeof *heads);
    for (size_t i = 0; i < sensors; i++) {
        scores[i] = summary->sensors.items[i];
        heads[i] = scores[i].sensor;
    }
    scores[sensors] = summary->all;
    heads[sensors] = "all";
    text_format(text,
                "%" PRId64 " frames; distances in cells, cut off at %g; in azimuth a cell is ",
                summary->frames, summary->cutoff);
    if (summary->azimuth_cell_rad > 0)
        text_format(text, "%g deg\n", summary->azimuth_cell_rad * (180 / PI));
    else
        text_add_word(text, "a twentieth of the view\n");
    struct table table = {
        .scores = scores,
        .heads = heads,
        .count = sensors == 1 ? 1 : sensors + 1,
        .distance = "cells",
        .square = "cells^2",
        .row = arena_get(arena, (sensors + 1) * sizeof(double)),
        .rows = &(struct text){0},
    };
    write_table(&table, text);
}

void score_table_track_summary(const struct score_summary *summary, struct text *text)
{
    text_format(text,
                "%" PRId64 " frames; distances in metres, cut off at %g; %" PRId64
                " identity switches\n",
                summary->frames, summary->cutoff_m, summary->id_switches);
    struct table table = {
        &summary->all,    (const char *const[]){"all"}, 1, "m", "m^2", (double[1]){0},
        &(struct text){0}};
    write_table(&table, text);
    if ((summary->present & SCORE_DIFFERENCE) != 0)
        tracker_difference_table(&summary->difference, text);
}
