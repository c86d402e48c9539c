/* Scores: how far the targets of this stream are from those of another, the truth. */
#include "base/units.h"
#include "frame/frame_sequence.h"
#include "run/stage.h"
#include "score/ensemble.h"
#include "score/reference_stream.h"
#include "score/target_score.h"

struct score_state {
    const char *truth;
    double azimuth_cell_rad;
    bool summary, text, ensemble;
    struct reference_stream *other;
    int64_t frames;
    struct frame_sequence sequence;
    struct score_tallies sensors; /* for the summary */
    struct ensemble lists;        /* for the ensemble */
};

static int score_start(void *state, struct runner *runner)
{
    struct score_state *own = state;
    own->summary = own->summary || own->text;
    own->lists.arena = runner_arena(runner);
    own->other = runner_reference_stream(runner, own->truth, &frame_record, false);
    return own->other != NULL ? 0 : -1;
}

static int score_step(void *state, struct frame *frame, struct runner *runner)
{
    struct score_state *own = state;
    const struct frame *truth;
    if (own->ensemble)
        return ensemble_add(&own->lists, frame, runner_diag(runner));
    if (frame_sequence_ascend(&own->sequence, frame, runner_place(runner), runner_arena(runner),
                              runner_diag(runner)) != 0 ||
        reference_stream_frame(own->other, frame, &truth, runner_diag(runner)) < 0)
        return -1;
    own->frames++;
    struct score_line line = {
        .scene = frame->scene, .frame = frame->frame, .time_s = frame->time_s};
    for (size_t i = 0; i < truth->sensors.list.count; i++) {
        const struct sensor_view *view = &truth->sensors.list.items[i];
        if (!view->measured && !frame->sensors.list.items[i].measured)
            continue;
        struct target_cell cell = target_score_cell(view, own->azimuth_cell_rad);
        struct score_tally scan = {.sensor = view->name};
        target_score_scan(&scan, truth, frame, &cell, frame->arena);
        if (own->summary)
            score_merge_sensor(&own->sensors, &scan, runner_arena(runner));
        else
            *list_add(&line.sensors, frame->arena) = score_of(&scan, 1, frame->arena);
    }
    return own->summary ? 0 : runner_write_record(runner, &score_line_record, &line);
}

/* The stream is read; now the whole truth is. */
static int write_ensemble(struct score_state *own, struct runner *runner)
{
    struct ensemble truth = {.arena = runner_arena(runner)};
    const struct frame *frame;
    int more;
    while ((more = reference_stream_next(own->other, &frame, runner_diag(runner))) > 0)
        if (ensemble_add(&truth, frame, runner_diag(runner)) != 0)
            return reference_stream_prefix(own->other, runner_diag(runner));
    struct ensemble_score score;
    if (more < 0 || ensemble_compare(&truth, &own->lists, own->azimuth_cell_rad,
                                     runner_arena(runner), &score, runner_diag(runner)) != 0)
        return -1;
    if (!own->text)
        return runner_write_record(runner, &ensemble_score_record, &score);
    struct text text = {0};
    ensemble_table(&score, &text);
    return runner_write_fitted(runner, &text);
}

static int score_stop(void *state, struct runner *runner)
{
    struct score_state *own = state;
    if (own->ensemble)
        return write_ensemble(own, runner);
    if (reference_stream_finish(own->other, runner_diag(runner)) != 0)
        return -1;
    struct score_summary summary = {
        .frames = own->frames,
        .cutoff = TARGET_SCORE_CUTOFF,
        .azimuth_cell_rad = own->azimuth_cell_rad,
    };
    if (!own->summary)
        return 0;
    score_summarize(&own->sensors, &summary, runner_arena(runner));
    if (!own->text)
        return runner_write_record(runner, &score_summary_record, &summary);
    struct text text = {0};
    score_table_summary(&summary, &text, runner_arena(runner));
    return runner_write_fitted(runner, &text);
}

static const struct field score_options[] = {
    {FIELD_NAME_OF(struct score_state, truth, "frames with the targets that are the truth"),
     .word = "FILE"},
    {OPTIONAL_REAL(
        struct score_state, azimuth_cell_rad, 1e-6, 2 * PI,
        "cell in azimuth; absent: that of the suite, or a twentieth of the field of view")},
    {OPTIONAL_FLAG(struct score_state, summary, "write one JSON line for the whole stream")},
    {OPTIONAL_FLAG(struct score_state, ensemble,
                   "compare the lists of many seeds as random lists, by their energy distance")},
    {OPTIONAL_FLAG(struct score_state, text,
                   "write the summary as a table for people instead of JSON")},
    {0},
};

const struct stage stage_score = {
    .name = "score",
    .summary = "Score targets against those of another stream, frame by frame.",
    .details =
        "Both streams must have the same scenes and frames, and the frames of a scene must "
        "ascend; scenes may interleave in another way. A scene is a name and a seed; the seeds of "
        "one name must come in the same order. Suites may differ, but the names of their sensors "
        "must not.\n\n"
        "Writes a JSON line for each frame, with a score for each sensor that measured: GOSPA "
        "(order 2, alpha 2) with its parts, OSPA, counts, differences of the pairs, and the "
        "Wasserstein-1 distance of each component. Targets 2 cells apart or more are no pair. "
        "Scans that one side alone made are counted and "
        "not compared. The distance of two targets is in "
        "cells, d^2 = (range / cell_range_m)^2 + (range rate / cell_range_rate_mps)^2 + (azimuth "
        "/ azimuth_cell_rad)^2, with the cells of the truth's sensors. A frame that one side "
        "lacks is an error. --summary keeps every value, which takes "
        "half a kilobyte for each target. glint-score-tracks scores trackers.\n\n"
        "With --ensemble each stream has every scene with at least 3 seeds; no seed may be in "
        "both streams. The lists of a scene, frame and sensor are samples of two random lists. "
        "The output has the energy distance of each scene with its standard error, and the mean "
        "over scenes with a 95 % interval. The mean distance is 0 if both streams draw from one "
        "law. Cells are those above; amplitudes count in steps of 3 dB.",
    .options = STAGE_OPTIONS(struct score_state, score_options),
    .sink = true,
    .reads = PART_SENSORS | PART_TARGETS,
    .start = score_start,
    .step = score_step,
    .stop = score_stop,
};
