/* Scores: how far the targets of this stream are from those of another one, frame by frame. */
#include <string.h>

#include "frame_text.h"
#include "stage.h"
#include "target_score.h"

struct score_state {
    const char *truth;
    double cutoff, azimuth_cell_rad;
    bool partial, summary;
    struct counterpart *other;
    int64_t frames;
    LIST_OF(struct score_tally) sensors; /* by name; for the summary */
};

static int score_start(void *state, struct runner *runner)
{
    struct score_state *own = state;
    own->other = runner_counterpart(runner, own->truth, own->partial);
    return own->other != NULL ? 0 : -1;
}

/* Suites may differ, for models are what is compared, but not in what their sensors are called. */
static int check_sensors(const struct sensors *truth, const struct sensors *listed,
                         struct diag *diag)
{
    if (truth->list.count != listed->list.count)
        return diag_fail(diag, DIAG_DATA, "sensors.list: %zu sensors; the truth has %zu",
                         listed->list.count, truth->list.count);
    for (size_t i = 0; i < truth->list.count; i++) {
        const struct sensor_view *view = &truth->list.items[i];
        if (strcmp(view->name, listed->list.items[i].name) != 0)
            return diag_fail(diag, DIAG_DATA, "sensors.list: \"%s\"; the truth has \"%s\"",
                             listed->list.items[i].name, view->name);
        if (!(view->cell_range_m > 0 && view->cell_range_rate_mps > 0))
            return diag_fail(diag, DIAG_DATA,
                             "sensors.list: the truth's \"%s\" has cells of %g m by %g m/s; "
                             "distances need more than 0",
                             view->name, view->cell_range_m, view->cell_range_rate_mps);
    }
    return 0;
}

static struct score_tally *tally_of(struct score_state *own, const char *sensor,
                                    struct arena *arena)
{
    for (size_t i = 0; i < own->sensors.count; i++)
        if (strcmp(own->sensors.items[i].sensor, sensor) == 0)
            return &own->sensors.items[i];
    struct score_tally *tally = list_add(&own->sensors, arena);
    tally->sensor = arena_text(arena, sensor, strlen(sensor));
    return tally;
}

static int write_line(struct runner *runner, const struct record *record, const void *line)
{
    struct text text = {0};
    frame_text_write_record(record, line, &text);
    int result = runner_write(runner, text.bytes, text.length);
    text_free(&text);
    return result;
}

static int score_step(void *state, struct frame *frame, struct runner *runner)
{
    struct score_state *own = state;
    struct arena *arena = frame->arena;
    const struct frame *truth;
    int found = counterpart_frame(own->other, frame, SECTION_SENSORS | SECTION_TARGETS, &truth,
                                  runner_diag(runner));
    if (found <= 0)
        return found;
    if (check_sensors(&truth->sensors, &frame->sensors, runner_diag(runner)) != 0)
        return -1;
    own->frames++;
    struct score_line line = {
        .scene = frame->scene, .frame = frame->frame, .time_s = frame->time_s};
    for (size_t i = 0; i < frame->sensors.list.count; i++) {
        const struct sensor_view *view = &truth->sensors.list.items[i];
        if (!view->measured && !frame->sensors.list.items[i].measured)
            continue;
        struct target_cell cell = {view->cell_range_m, own->azimuth_cell_rad,
                                   view->cell_range_rate_mps, own->cutoff};
        struct score_tally scan = {.sensor = view->name};
        target_score_scan(&scan, view->name, truth, frame, &cell, arena);
        if (own->summary)
            score_merge(tally_of(own, view->name, runner_arena(runner)), &scan,
                        runner_arena(runner));
        else
            *list_add(&line.sensors, arena) = score_of(&scan, arena);
    }
    return own->summary ? 0 : write_line(runner, &score_line_record, &line);
}

static int score_stop(void *state, struct runner *runner)
{
    struct score_state *own = state;
    struct arena *arena = runner_arena(runner);
    if (counterpart_finish(own->other, runner_diag(runner)) != 0)
        return -1;
    if (!own->summary)
        return 0;
    struct score_summary summary = {
        .frames = own->frames,
        .true_frames = counterpart_left(own->other),
        .listed_frames = counterpart_absent(own->other),
        .cutoff = own->cutoff,
        .azimuth_cell_rad = own->azimuth_cell_rad,
    };
    struct score_tally all = {0};
    for (size_t i = 0; i < own->sensors.count; i++) {
        *list_add(&summary.sensors, arena) = score_of(&own->sensors.items[i], arena);
        score_merge(&all, &own->sensors.items[i], arena);
    }
    summary.all = score_of(&all, arena);
    return write_line(runner, &score_summary_record, &summary);
}

static const struct field score_options[] = {
    {FIELD_NAME_OF(struct score_state, truth, "frames with targets to compare with"),
     .word = "FILE"},
    {FIELD_REAL_IN(struct score_state, cutoff, 1e-6, 1e6,
                   "targets this many cells apart are no pair (absent: 2)"),
     FIELD_OPTIONAL, .absent = 2},
    {FIELD_REAL_IN(struct score_state, azimuth_cell_rad, 1e-6, 2 * PI,
                   "what counts as one cell in azimuth (absent: 0.035, which is 2 degrees)"),
     FIELD_OPTIONAL, .absent = 0.035},
    {FIELD_FLAG_OF(struct score_state, partial,
                   "count frames that only one side has instead of refusing them"),
     FIELD_OPTIONAL},
    {FIELD_FLAG_OF(struct score_state, summary, "write one line for the whole stream"),
     FIELD_OPTIONAL},
    {0},
};

static const struct record score_record = {
    .name = "stage", .size = sizeof(struct score_state), .fields = score_options};

const struct stage stage_score = {
    .name = "score",
    .summary = "Score targets against those of another stream, frame by frame.",
    .details =
        "Both streams must be of the same scenes and frames, ascending within a scene; scenes\n"
        "may interleave differently. Suites may differ, but not the names of their sensors.\n"
        "Writes a JSON line for each frame, with a score for each sensor that measured on\n"
        "either side: GOSPA (order 2, alpha 2) with its parts, OSPA, counts, differences of the\n"
        "pairs, and the Wasserstein-1 distance of each component. The distance of two targets\n"
        "is in cells, d^2 = (range / cell_range_m)^2 + (range rate / cell_range_rate_mps)^2 +\n"
        "(azimuth / azimuth_cell_rad)^2, with the cells of the truth's sensors. Frames that one\n"
        "side lacks are errors unless --partial is given. For the summary every value is kept,\n"
        "about 100 bytes for each target.",
    .options = &score_record,
    .sink = true,
    .reads = SECTION_SENSORS | SECTION_TARGETS,
    .start = score_start,
    .step = score_step,
    .stop = score_stop,
};
