/* Scores of a tracker: how far its tracks are from the objects of the frames. */
#include "base/intern.h"
#include "documents/vehicle.h"
#include "frame/frame_sequence.h"
#include "run/stage.h"
#include "score/reference_stream.h"

struct score_tracks {
    const char *tracks, *classes;
    enum track_truth objects;
    double cutoff_m;
    bool partial, summary, text;
    struct reference_stream *other;
    int64_t frames, id_switches;
    struct score_tally tally; /* for the summary */
    struct track_memory memory;
    struct frame_sequence sequence;
    struct intern seen; /* classes of all objects but the egos, for --classes */
};

static int score_tracks_start(void *state, struct runner *runner)
{
    struct score_tracks *own = state;
    own->summary = own->summary || own->text;
    own->other = runner_reference_stream(runner, own->tracks, &track_list_record, own->partial);
    return own->other != NULL ? 0 : -1;
}

static void note_classes(struct score_tracks *own, const struct frame *frame, struct arena *arena)
{
    for (size_t i = 0; i < frame->objects.count; i++)
        if (!frame_same_name(frame->objects.items[i].id, frame->ego))
            intern_word(&own->seen, frame->objects.items[i].class, arena);
}

/* Refuses a class that no object has, unless a document describes it: it is misspelt. */
static int check_classes(struct score_tracks *own, struct runner *runner)
{
    struct arena *arena = runner_arena(runner);
    size_t seen = own->seen.list.count;
    for (const char *at = own->classes; at != NULL;) {
        size_t length = strcspn(at, ",");
        const char *class = arena_text(arena, at, length);
        struct diag unused = {0};
        if (intern_word(&own->seen, class, arena) >= seen &&
            vehicle_load(class, NULL, arena, &unused) == NULL)
            return diag_fail(runner_diag(runner), DIAG_DATA,
                             "--classes: no object of the stream is of the class \"%s\", and no "
                             "vehicle document describes it",
                             class);
        at = at[length] == ',' ? at + length + 1 : NULL;
    }
    return 0;
}

static int score_tracks_step(void *state, struct frame *frame, struct runner *runner)
{
    struct score_tracks *own = state;
    struct arena *lasting = runner_arena(runner);
    struct track_list tracks;
    if (frame_sequence_ascend(&own->sequence, frame, runner_place(runner), lasting,
                              runner_diag(runner)) != 0 ||
        frame_sequence_one_seed(&own->sequence, runner_diag(runner)) != 0 ||
        track_score_check(frame, own->objects, runner_diag(runner)) != 0)
        return -1;
    if (own->classes != NULL)
        note_classes(own, frame, lasting);
    int found = reference_stream_tracks(own->other, frame, &tracks, runner_diag(runner));
    if (found <= 0)
        return found;
    struct score_tally tally = {0};
    int64_t switches = track_score_frame(&tally, frame, &tracks, own->objects, own->classes,
                                         own->cutoff_m, &own->memory, lasting);
    if (frame->last)
        track_score_forget(&own->memory, frame->scene);
    own->frames++;
    own->id_switches += switches;
    if (own->summary) {
        score_merge(&own->tally, &tally, lasting);
        return 0;
    }
    struct score_line line = {
        .scene = frame->scene,
        .frame = frame->frame,
        .time_s = frame->time_s,
        .id_switches = switches,
        .all = score_of(&tally, 1, frame->arena),
    };
    return runner_write_record(runner, &score_track_line_record, &line);
}

static int score_tracks_stop(void *state, struct runner *runner)
{
    struct score_tracks *own = state;
    if (reference_stream_finish(own->other, runner_diag(runner)) != 0 ||
        check_classes(own, runner) != 0)
        return -1;
    if (!own->summary)
        return 0;
    struct score_summary summary = {
        .frames = own->frames,
        .true_frames = reference_stream_missing(own->other),
        .listed_frames = reference_stream_unmatched(own->other),
        .cutoff_m = own->cutoff_m,
        .id_switches = own->id_switches,
        .all = score_of(&own->tally, 1, runner_arena(runner)),
    };
    if (!own->text)
        return runner_write_record(runner, &score_track_summary_record, &summary);
    struct text text = {0};
    score_table_track_summary(&summary, &text);
    return runner_write_text(runner, &text);
}

static const struct field score_tracks_options[] = {
    {FIELD_NAME_OF(struct score_tracks, tracks,
                   "the tracker's tracks, as schemas/tracks.json describes them"),
     .word = "FILE"},
    {OPTIONAL_CHOICE(struct score_tracks, objects, track_score_truths,
                     "which objects a tracker should find; absent: in_view")},
    {OPTIONAL_NAME(struct score_tracks, classes, "only objects of these classes: car,truck"),
     .word = "LIST"},
    {OPTIONAL_REAL(struct score_tracks, cutoff_m, 1e-6, 1e6,
                   "a track that far from an object is no pair with it; absent: 5 m"),
     .absent = TRACK_SCORE_CUTOFF_M},
    {OPTIONAL_FLAG(struct score_tracks, partial,
                   "count frames that only one side has instead of refusing them")},
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
        "of the pairs, and how many objects are paired with another track than last time. "
        "--objects chooses the objects that count: in_view, if their centre is within the range "
        "and field of view of a sensor; detected, if an echo of theirs is in a target of the "
        "frame; all. The ego never counts. A frame that one side lacks is an error, unless "
        "--partial is given. Tracks have no seed, so every scene of the stream must have one seed "
        "alone.",
    .options = STAGE_OPTIONS(struct score_tracks, score_tracks_options),
    .sink = true,
    .reads = SECTION_OBJECTS,
    .start = score_tracks_start,
    .step = score_tracks_step,
    .stop = score_tracks_stop,
};
