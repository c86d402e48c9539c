/* Scores of a tracker: how far its tracks are from the objects of the frames. */
#include "base/intern.h"
#include "frame/frame_sequence.h"
#include "run/stage.h"
#include "score/reference_stream.h"

struct tracker {
    struct reference_stream *stream; /* NULL: there is no such tracker */
    struct track_memory memory;
    struct track_list tracks; /* of the frame */
    struct score_tally tally;
    int64_t switches;
};

struct score_tracks {
    const char *tracks, *against, *classes;
    enum track_truth objects;
    bool summary, text;
    struct tracker tracker, other; /* of --tracks and --against */
    int64_t frames, id_switches;
    struct score_tally tally; /* for the summary */
    struct tracker_scenes scenes;
    struct frame_sequence sequence;
    struct intern seen; /* classes of all objects but the egos, for --classes */
};

static int score_tracks_start(void *state, struct runner *runner)
{
    struct score_tracks *own = state;
    own->summary = own->summary || own->text || own->against != NULL;
    own->tracker.stream = runner_reference_stream(runner, own->tracks, &track_list_record, false);
    if (own->tracker.stream == NULL || own->against == NULL)
        return own->tracker.stream != NULL ? 0 : -1;
    if (strcmp(own->tracks, "-") == 0 && strcmp(own->against, "-") == 0)
        return diag_fail(runner_diag(runner), DIAG_USAGE,
                         "--tracks and --against are both standard input; expected a file for one");
    own->other.stream = runner_reference_stream(runner, own->against, &track_list_record, false);
    return own->other.stream != NULL ? 0 : -1;
}

/* Reads the tracks of the frame. */
static int read_tracks(struct tracker *tracker, const struct frame *frame, struct runner *runner)
{
    if (tracker->stream == NULL)
        return 0;
    struct diag *diag = runner_diag(runner);
    return reference_stream_tracks(tracker->stream, frame, &tracker->tracks, diag) < 0 ? -1 : 0;
}

static void score_tracker(const struct score_tracks *own, struct tracker *tracker,
                          const struct frame *frame, struct arena *lasting)
{
    tracker->tally = (struct score_tally){0};
    tracker->switches = track_score_frame(&tracker->tally, frame, &tracker->tracks, own->objects,
                                          own->classes, &tracker->memory, lasting);
    if (frame->last)
        track_score_forget(&tracker->memory, frame->scene);
}

static void compare_trackers(struct score_tracks *own, const struct frame *frame,
                             struct arena *lasting)
{
    double figures[2][TRACKER_FIGURES];
    const struct tracker *trackers[] = {&own->tracker, &own->other};
    score_tracker(own, &own->other, frame, lasting);
    for (int i = 0; i < 2; i++) {
        const struct score_tally *tally = &trackers[i]->tally;
        figures[i][TRACKER_GOSPA] = tally->gospa_sum;
        figures[i][TRACKER_MISSED] = (double)(tally->truths - tally->pairs);
        figures[i][TRACKER_FALSE] = (double)(tally->listed - tally->pairs);
        figures[i][TRACKER_SWITCHES] = (double)trackers[i]->switches;
    }
    if (own->tracker.tally.scans > 0)
        tracker_difference_add(&own->scenes, frame->scene, figures[0], figures[1], lasting);
}

static int score_tracks_step(void *state, struct frame *frame, struct runner *runner)
{
    struct score_tracks *own = state;
    struct arena *lasting = runner_arena(runner);
    struct tracker *tracker = &own->tracker;
    if (frame_sequence_ascend(&own->sequence, frame, runner_place(runner), lasting,
                              runner_diag(runner)) != 0 ||
        frame_sequence_one_seed(&own->sequence, runner_diag(runner)) != 0 ||
        track_score_check(frame, own->objects, runner_diag(runner)) != 0)
        return -1;
    if (own->classes != NULL)
        track_score_note_classes(&own->seen, frame, lasting);
    if (read_tracks(tracker, frame, runner) != 0 || read_tracks(&own->other, frame, runner) != 0)
        return -1;
    score_tracker(own, tracker, frame, lasting);
    if (own->other.stream != NULL)
        compare_trackers(own, frame, lasting);
    own->frames++;
    own->id_switches += tracker->switches;
    if (own->summary) {
        score_merge(&own->tally, &tracker->tally, lasting);
        return 0;
    }
    struct score_line line = {
        .scene = frame->scene,
        .frame = frame->frame,
        .time_s = frame->time_s,
        .id_switches = tracker->switches,
        .all = score_of(&tracker->tally, 1, frame->arena),
    };
    return runner_write_record(runner, &score_track_line_record, &line);
}

static int score_tracks_stop(void *state, struct runner *runner)
{
    struct score_tracks *own = state;
    if (reference_stream_finish(own->tracker.stream, runner_diag(runner)) != 0 ||
        (own->other.stream != NULL &&
         reference_stream_finish(own->other.stream, runner_diag(runner)) != 0) ||
        track_score_check_classes(&own->seen, own->classes, runner_arena(runner),
                                  runner_diag(runner)) != 0)
        return -1;
    if (!own->summary)
        return 0;
    struct score_summary summary = {
        .frames = own->frames,
        .cutoff_m = TRACK_SCORE_CUTOFF_M,
        .id_switches = own->id_switches,
        .all = score_of(&own->tally, 1, runner_arena(runner)),
    };
    if (own->other.stream != NULL) {
        if (tracker_difference_of(&own->scenes, &summary.difference, runner_diag(runner)) != 0)
            return -1;
        summary.present = SCORE_DIFFERENCE;
    }
    if (!own->text)
        return runner_write_record(runner, &score_track_summary_record, &summary);
    struct text text = {0};
    score_table_track_summary(&summary, &text);
    return runner_write_fitted(runner, &text);
}

static const struct field score_tracks_options[] = {
    {FIELD_NAME_OF(struct score_tracks, tracks,
                   "the tracker's tracks, as schemas/tracks.json describes them"),
     .word = "FILE"},
    {OPTIONAL_NAME(struct score_tracks, against,
                   "another tracker's tracks; the summary has the scores of --tracks less theirs"),
     .word = "FILE"},
    {OPTIONAL_CHOICE(struct score_tracks, objects, track_score_truths,
                     "the objects that a tracker should find; absent: in_view")},
    {OPTIONAL_NAME(
         struct score_tracks, classes,
         "only objects of these classes: car,truck; absent: all but guardrail, post, wall"),
     .word = "LIST"},
    {OPTIONAL_FLAG(struct score_tracks, summary, "write one JSON line for the whole stream")},
    {OPTIONAL_FLAG(struct score_tracks, text,
                   "write the summary as a table for people instead of JSON")},
    {0},
};

const struct stage stage_score_tracks = {
    .name = "score-tracks",
    .summary = "Score a tracker's tracks against the objects of the frames.",
    .details =
        "The frames are the truth. The tracks are JSON lines, one for each frame, in the frames' "
        "coordinates. In a pipe: tracker <list.jsonl | glint-score-tracks --tracks - "
        "list.jsonl.\n\n"
        "Writes a JSON line for each frame: GOSPA (order 2, alpha 2) over the distances of "
        "centres in metres, with its parts, OSPA, counts, distances and differences in velocity "
        "of the pairs, which are less than 5 m apart, and how many objects are paired with another "
        "track than last time. Tracks "
        "with a covariance P also get the NEES e' P^-1 e of their distance e, 2 on average if P "
        "is right. --objects chooses the objects that count: in_view, if their centre is within "
        "the range and field of view of a sensor; detected, if a target of the frame contains one "
        "of their echoes, where frames without a measurement are counted and not scored; all. The "
        "ego never counts, and guardrails, posts and walls only where --classes names them. A "
        "track "
        "without a pair within 2 m of the box of an object that does not count is neither right "
        "nor "
        "false, and not in listed_count. A frame that one side lacks is an error. "
        "Tracks have no seed, so each scene of the stream must have a "
        "single seed.\n\n"
        "--against has the tracks of another tracker, or those from another chain's lists. The "
        "summary then has the differences of both scores per frame, paired by scene, with "
        "Student's 95 % interval over scenes; the stream needs at least 5 scenes.",
    .options = STAGE_OPTIONS(struct score_tracks, score_tracks_options),
    .sink = true,
    .reads = PART_OBJECTS,
    .start = score_tracks_start,
    .step = score_tracks_step,
    .stop = score_tracks_stop,
};
