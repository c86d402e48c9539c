#include "score/score.h"

#include "base/elementary.h"
#include "base/sort.h"
#include "frame/frame_order.h"
#include "score/error_statistics.h"

#define COUNT(owner, member, help) FIELD_INTEGER_IN(owner, member, 0, 0x1p53, help)
#define MEASURE(member, help) FIELD_REAL_IN(struct score, member, 0, 1e300, help)
#define DIFFERENCE(member, low, bit, help)                                                         \
    FIELD_REAL_IN(struct score_differences, member, low, 1e300, help), FIELD_OPTIONAL,             \
        .section = (bit)

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
    {COUNT(struct score, true_count, "items of the true lists")},
    {COUNT(struct score, listed_count, "items of the scored lists")},
    {COUNT(struct score, pair_count, "pairs closer than the cut-off")},
    {COUNT(struct score, missed_count, "true items without a pair")},
    {COUNT(struct score, false_count, "scored items without a pair")},
    {MEASURE(gospa, "mean GOSPA over the scans")},
    {MEASURE(gospa_rms,
             "root mean square of GOSPA over the scans; its square is the sum of the parts")},
    {MEASURE(gospa_max, "largest GOSPA of a scan")},
    {MEASURE(gospa_localisation, "part of the pairs' squared distances, mean over the scans")},
    {MEASURE(gospa_missed,
             "part of missed items, half the squared cut-off each, mean over the scans")},
    {MEASURE(gospa_false,
             "part of false items, half the squared cut-off each, mean over the scans")},
    {MEASURE(ospa, "mean OSPA over the scans")},
    {COMPONENT(range_m, SCORE_RANGE, "differences in range")},
    {COMPONENT(azimuth_rad, SCORE_AZIMUTH, "differences in azimuth")},
    {COMPONENT(range_rate_mps, SCORE_RANGE_RATE, "differences in range rate")},
    {COMPONENT(amplitude_db, SCORE_AMPLITUDE, "differences in amplitude")},
    {COMPONENT(position_m, SCORE_POSITION, "distances of tracks and objects")},
    {COMPONENT(velocity_mps, SCORE_VELOCITY,
               "sizes of the differences in velocity of tracks and objects")},
    {0},
};

const struct record score_record = {FIELD_TABLE(
    struct score, score_fields, "score",
    "How lists differ from the truth; GOSPA and OSPA are in cells for targets, in metres for "
    "tracks.")};

#define LINE_HEAD(owner)                                                                           \
    {FIELD_NAME_OF(owner, scene, "scene of the frame")},                                           \
        {COUNT(owner, frame, "number of the frame in its scene")},                                 \
    {                                                                                              \
        FIELD_REAL_IN(owner, time_s, -1e10, 1e10, "time of the frame")                             \
    }
#define SUMMARY_HEAD(owner)                                                                        \
    {COUNT(owner, frames, "frames in both streams, which are scored")},                            \
        {COUNT(owner, true_frames, "frames in the truth alone")},                                  \
    {                                                                                              \
        COUNT(owner, listed_frames, "frames in the scored stream alone")                           \
    }

static const struct field line_fields[] = {
    LINE_HEAD(struct score_line),
    {FIELD_LIST_OF(struct score_line, sensors, &score_record,
                   "scores of the sensors that measured, by name")},
    {0},
};

const struct record score_line_record = {FIELD_TABLE(struct score_line, line_fields, "score_line",
                                                     "Scores of one frame, by glint-score.")};

static const struct field summary_fields[] = {
    SUMMARY_HEAD(struct score_summary),
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
    LINE_HEAD(struct score_track_line),
    {COUNT(struct score_track_line, id_switches,
           "objects paired with another track than the last time")},
    {FIELD_RECORD_OF(struct score_track_line, all, &score_record, "score over all tracks")},
    {0},
};

const struct record score_track_line_record = {
    FIELD_TABLE(struct score_track_line, track_line_fields, "score_track_line",
                "Score of one frame, by glint-score-tracks.")};

static const struct field track_summary_fields[] = {
    SUMMARY_HEAD(struct score_track_summary),
    {FIELD_REAL_IN(struct score_track_summary, cutoff_m, 0, 1e6,
                   "tracks this far off or farther are no pair")},
    {COUNT(struct score_track_summary, id_switches,
           "objects paired with another track than the last time")},
    {FIELD_RECORD_OF(struct score_track_summary, all, &score_record, "score over all frames")},
    {0},
};

const struct record score_track_summary_record = {
    FIELD_TABLE(struct score_track_summary, track_summary_fields, "score_track_summary",
                "Score of a stream, by glint-score-tracks --summary.")};

void score_add_scan(struct score_tally *tally, double squares, size_t pairs, size_t truths,
                    size_t listed, double cutoff)
{
    struct gospa gospa = gospa_of(squares, pairs, truths, listed, cutoff);
    tally->scans++;
    tally->truths += (int64_t)truths;
    tally->listed += (int64_t)listed;
    tally->pairs += (int64_t)pairs;
    tally->gospa_sum += gospa.value;
    tally->gospa_max = elementary_max(tally->gospa_max, gospa.value);
    tally->localisation += gospa.localisation;
    tally->missed_part += gospa.missed_part;
    tally->false_part += gospa.false_part;
    tally->ospa_sum += gospa.ospa;
}

void score_add_value(struct score_values *values, double value, struct arena *arena)
{
    *list_add(&values->list, arena) = value;
}

static void append(struct score_values *values, const struct score_values *more,
                   struct arena *arena)
{
    for (size_t i = 0; i < more->list.count; i++)
        score_add_value(values, more->list.items[i], arena);
}

/* Adds counts and sums, but no values. */
static void add_sums(struct score_tally *tally, const struct score_tally *other)
{
    tally->scans += other->scans;
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

void score_merge(struct score_tally *tally, const struct score_tally *other, struct arena *arena)
{
    add_sums(tally, other);
    for (int kind = 0; kind < SCORE_KINDS; kind++)
        for (int i = 0; i < SCORE_COMPONENTS; i++)
            append(&tally->values[kind][i], &other->values[kind][i], arena);
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
    if (errors.list.count > 0) {
        struct error_statistics statistics =
            error_statistics_of(errors.list.items, errors.list.count, arena);
        differences = (struct score_differences){
            statistics.mean, statistics.rms, statistics.p95, statistics.max, 0, SCORE_PAIRS};
    }
    if (truth.list.count > 0 && listed.list.count > 0) {
        differences.wasserstein = error_statistics_wasserstein(
            truth.list.items, truth.list.count, listed.list.items, listed.list.count, arena);
        differences.present |= SCORE_LISTS;
    }
    return differences;
}

struct score score_of(const struct score_tally *tallies, size_t count, struct arena *arena)
{
    struct score_tally all = {0};
    for (size_t i = 0; i < count; i++)
        add_sums(&all, &tallies[i]);
    double scans = all.scans > 0 ? (double)all.scans : 1;
    struct score score = {
        .sensor = count > 0 ? tallies->sensor : NULL,
        .scans = all.scans,
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
