#include "view/view_comparison.h"

#include "score/target_score.h"

/* The number of a target in its sensor's list, from 1. */
static uint32_t number_in_list(const struct frame *frame, const struct target *target)
{
    uint32_t number = 0;
    for (const struct target *one = frame->targets.items; one <= target; one++)
        number += strcmp(one->sensor, target->sensor) == 0;
    return number;
}

static uint32_t add_truths(struct view_data *data, const struct frame *frame,
                           const struct target_pairs *pairs)
{
    uint32_t count = 0;
    for (size_t i = 0; i < pairs->list.count && pairs->list.items[i].truth != NULL; i++, count++) {
        const struct target *truth = pairs->list.items[i].truth;
        const struct target *listed = pairs->list.items[i].listed;
        view_data_real(data, COLUMN_TRUTH_RANGE, truth->range_m);
        view_data_real(data, COLUMN_TRUTH_AZIMUTH, truth->azimuth_rad);
        view_data_real(data, COLUMN_TRUTH_RATE, truth->range_rate_mps);
        view_data_real(data, COLUMN_TRUTH_AMPLITUDE, truth->amplitude_db);
        view_data_name(data, COLUMN_TRUTH_OBJECT, truth->contributors.items[0].id.object);
        view_data_count(data, COLUMN_TRUTH_LISTED,
                        listed != NULL ? number_in_list(frame, listed) : 0);
    }
    return count;
}

static int compare_targets(struct view_comparison *comparison, struct view_data *data,
                           const struct frame *frame, struct diag *diag)
{
    const struct frame *truth;
    int found = reference_stream_frame(comparison->truth, frame, SECTION_SENSORS | SECTION_TARGETS,
                                       &truth, diag);
    if (found < 0 ||
        (found > 0 && (reference_stream_same_seed(comparison->truth, frame, diag) != 0 ||
                       target_score_check(truth, frame, diag) != 0)))
        return -1;
    view_data_count(data, COLUMN_FRAME_COMPARED, (uint32_t)found);
    for (size_t i = 0; i < frame->sensors.list.count; i++) {
        struct target_pairs pairs = {0};
        if (found > 0) {
            const struct sensor_view *view = &truth->sensors.list.items[i];
            struct target_cell cell = target_score_cell(view, 0, TARGET_SCORE_CUTOFF);
            pairs = target_score_pairs(view->name, truth, frame, &cell, frame->arena);
        }
        view_data_count(data, COLUMN_SCAN_TRUTHS, add_truths(data, frame, &pairs));
    }
    return 0;
}

static void add_track(struct view_data *data, const struct frame *frame,
                      const struct track_pair *pair, const char *before)
{
    static const struct track missed = {0};
    const struct track *track = pair->track != NULL ? pair->track : &missed;
    struct vec2 shift = view_data_shift(data, frame);
    view_data_real(data, COLUMN_TRACK_X, track->x_m + shift.x);
    view_data_real(data, COLUMN_TRACK_Y, track->y_m + shift.y);
    view_data_real(data, COLUMN_TRACK_VX, track->vx_mps);
    view_data_real(data, COLUMN_TRACK_VY, track->vy_mps);
    view_data_real(data, COLUMN_TRACK_APART, pair->apart_m);
    view_data_name(data, COLUMN_TRACK_ID, track->id);
    view_data_name(data, COLUMN_TRACK_OBJECT, pair->object != NULL ? pair->object->id : NULL);
    view_data_name(data, COLUMN_TRACK_BEFORE, before);
}

static int compare_tracks(struct view_comparison *comparison, struct view_data *data,
                          const struct frame *frame, struct diag *diag)
{
    struct track_list tracks = {0};
    struct track_pairs pairs = {0};
    if (track_score_check(frame, TRACK_TRUTH_IN_VIEW, diag) != 0)
        return -1;
    int found = reference_stream_tracks(comparison->tracks, frame, &tracks, diag);
    if (found > 0)
        pairs = track_score_pairs(frame, &tracks, TRACK_TRUTH_IN_VIEW, NULL, TRACK_SCORE_CUTOFF_M);
    for (size_t i = 0; i < pairs.list.count; i++) {
        const struct track_pair *pair = &pairs.list.items[i];
        const char *before = NULL;
        if (pair->object != NULL && pair->track != NULL)
            before = track_score_replaced(&comparison->memory, frame->scene, pair->object->id,
                                          pair->track->id, data->arena);
        add_track(data, frame, pair, before);
    }
    if (frame->last)
        track_score_forget(&comparison->memory, frame->scene);
    view_data_count(data, COLUMN_FRAME_TRACKED, found > 0);
    view_data_count(data, COLUMN_FRAME_TRACKS, (uint32_t)pairs.list.count);
    return found < 0 ? -1 : 0;
}

int view_comparison_add(struct view_comparison *comparison, struct view_data *data,
                        const struct frame *frame, struct diag *diag)
{
    if (comparison->truth != NULL && compare_targets(comparison, data, frame, diag) != 0)
        return -1;
    return comparison->tracks != NULL ? compare_tracks(comparison, data, frame, diag) : 0;
}

int view_comparison_finish(struct view_comparison *comparison, struct diag *diag)
{
    if (comparison->truth != NULL && reference_stream_finish(comparison->truth, diag) != 0)
        return -1;
    return comparison->tracks != NULL ? reference_stream_finish(comparison->tracks, diag) : 0;
}
