#include "score/reference_stream.h"

#include <inttypes.h>
#include <stdlib.h>

#include "frame/frame_check.h"
#include "frame/frame_order.h"
#include "frame/frame_text.h"
#include "score/target_score.h"
#include "text/file_format.h"
#include "text/record_read.h"

/* A line that waits for its frame, with its text in one piece of memory. */
struct waiting_line {
    struct waiting_line *next;
    size_t number;
    int64_t frame;
    const char *scene;
    size_t length;
    char *bytes;
};

struct reference_stream {
    struct input *input;
    const struct record *record; /* of its lines */
    bool partial, ended;
    size_t read;      /* number of the line read last */
    size_t found;     /* number of the line found last, which is: */
    const char *line; /* valid until the next line is read */
    size_t length;
    const char *scene; /* of that line */
    int64_t number;    /* of its frame in the scene */
    struct waiting_line *first, **last;
    struct waiting_line *taken; /* the waiting line that was taken out last */
    struct frame frame;         /* if the lines are frames */
    struct track_list tracks;
    struct arena arena;
};

struct reference_stream *reference_stream_open(const char *path, const struct record *record,
                                               bool partial, struct input_pause pause,
                                               struct diag *diag)
{
    struct input *input = input_open(path, diag);
    if (input == NULL) {
        diag_prefix(diag, "%s: ", path);
        return NULL;
    }
    struct reference_stream *reference = memory_get(sizeof *reference);
    *reference = (struct reference_stream){.input = input, .record = record, .partial = partial};
    reference->last = &reference->first;
    reference->frame.arena = &reference->arena;
    input_before_waiting(input, pause);
    return reference;
}

void reference_stream_close(struct reference_stream *reference)
{
    if (reference == NULL)
        return;
    free(reference->taken);
    for (struct waiting_line *line = reference->first, *next; line != NULL; line = next) {
        next = line->next;
        free(line);
    }
    arena_free(&reference->arena);
    input_close(reference->input);
    free(reference);
}

int reference_stream_prefix(const struct reference_stream *reference, struct diag *diag)
{
    size_t length;
    const char *head = input_head(reference->input, &length);
    if (file_format_explain(reference->record->name, head, length, diag) ||
        diag->code == DIAG_NO_INPUT)
        return diag_prefix(diag, "%s: ", input_name(reference->input));
    return diag_prefix(diag, "%s:%zu: ", input_name(reference->input), reference->found);
}

/* Parses the line as a frame or as tracks. */
static int parse(struct reference_stream *reference, struct diag *diag)
{
    struct frame *frame = &reference->frame;
    struct track_list *tracks = &reference->tracks;
    if (reference->record == &frame_record) {
        int result = frame_text_read(reference->line, reference->length, frame, diag);
        reference->scene = frame->scene;
        reference->number = frame->frame;
        return result;
    }
    arena_clear(&reference->arena);
    field_clear(reference->record, tracks);
    int result = record_read(reference->line, reference->length, reference->record, tracks,
                             &reference->arena, NULL, diag);
    reference->scene = tracks->scene;
    reference->number = tracks->frame;
    return result;
}

static void keep_line(struct reference_stream *reference)
{
    size_t scene = strlen(reference->scene) + 1;
    struct waiting_line *line = memory_get(sizeof *line + scene + reference->length);
    char *text = (char *)(line + 1);
    *line = (struct waiting_line){.number = reference->read,
                                  .frame = reference->number,
                                  .scene = text,
                                  .length = reference->length,
                                  .bytes = text + scene};
    memcpy(text, reference->scene, scene);
    memcpy(line->bytes, reference->line, line->length);
    *reference->last = line;
    reference->last = &line->next;
}

static int skip_line(struct reference_stream *reference, size_t number, const char *scene,
                     int64_t frame, struct diag *diag)
{
    if (reference->partial)
        return 0;
    reference->found = number;
    diag_fail(diag, DIAG_DATA, "frame %lld of scene \"%s\" is not in the other stream",
              (long long)frame, scene);
    return reference_stream_prefix(reference, diag);
}

/* Takes a line out of the waiting ones; its memory is freed by the next call. */
static struct waiting_line *take_line(struct reference_stream *reference, struct waiting_line **at)
{
    struct waiting_line *line = *at;
    *at = line->next;
    if (reference->last == &line->next)
        reference->last = at;
    free(reference->taken);
    reference->taken = line;
    return line;
}

enum search { SEARCH_FAILED, SEARCH_ON, SEARCH_FOUND, SEARCH_PAST };

/* Searches the waiting lines. */
static enum search find_waiting(struct reference_stream *reference, const char *scene,
                                int64_t frame, struct diag *diag)
{
    for (struct waiting_line **at = &reference->first; *at != NULL;) {
        if (strcmp((*at)->scene, scene) != 0) {
            at = &(*at)->next;
            continue;
        }
        if ((*at)->frame > frame)
            return SEARCH_PAST;
        struct waiting_line *line = take_line(reference, at);
        if (line->frame == frame) {
            reference->found = line->number;
            reference->line = line->bytes;
            reference->length = line->length;
            return parse(reference, diag) == 0 ? SEARCH_FOUND : SEARCH_FAILED;
        }
        if (skip_line(reference, line->number, line->scene, line->frame, diag) != 0)
            return SEARCH_FAILED;
    }
    return SEARCH_ON;
}

static int read_line(struct reference_stream *reference, struct diag *diag)
{
    reference->found = ++reference->read;
    int more =
        input_line(reference->input, FRAME_TEXT_SIZE, &reference->line, &reference->length, diag);
    reference->ended = more == 0;
    return more;
}

/* Reads the next line. A line for a later frame or another scene waits; one that can match no frame
 * any more is skipped. If scene is NULL, no line matches. */
static enum search read_next(struct reference_stream *reference, const char *scene, int64_t frame,
                             struct diag *diag)
{
    int more = read_line(reference, diag);
    if (more < 0 || (more > 0 && parse(reference, diag) != 0)) {
        reference_stream_prefix(reference, diag);
        return SEARCH_FAILED;
    }
    if (more == 0)
        return SEARCH_PAST;
    bool same = scene != NULL && strcmp(reference->scene, scene) == 0;
    if (same && reference->number == frame)
        return SEARCH_FOUND;
    if (scene == NULL || (same && reference->number < frame))
        return skip_line(reference, reference->read, reference->scene, reference->number, diag) == 0
                   ? SEARCH_ON
                   : SEARCH_FAILED;
    keep_line(reference);
    return same ? SEARCH_PAST : SEARCH_ON;
}

/* Finds the line for a scene and frame: 1, 0 if there is none, -1. */
static int find(struct reference_stream *reference, const struct frame *frame, struct diag *diag)
{
    enum search search = find_waiting(reference, frame->scene, frame->frame, diag);
    while (search == SEARCH_ON)
        search =
            reference->ended ? SEARCH_PAST : read_next(reference, frame->scene, frame->frame, diag);
    if (search != SEARCH_PAST)
        return search == SEARCH_FOUND ? 1 : -1;
    if (reference->partial)
        return 0;
    return diag_fail(diag, DIAG_DATA, "frame: %s has no frame %lld of scene \"%s\"",
                     input_name(reference->input), (long long)frame->frame, frame->scene);
}

int reference_stream_lacks(const struct reference_stream *reference, const char *scene,
                           struct diag *diag)
{
    return diag_fail(diag, DIAG_DATA,
                     "%s has none of the frames of scene \"%s\"; expected the same scene",
                     input_name(reference->input), scene);
}

bool reference_stream_same_time(double a_s, double b_s)
{
    return fabs(a_s - b_s) <= 1e-6;
}

/* Refuses a stream of other scenes with the same names. */
static int check_time(const struct frame *frame, double time_s, struct diag *diag)
{
    if (reference_stream_same_time(time_s, frame->time_s))
        return 0;
    return diag_fail(diag, DIAG_DATA,
                     "time_s: %.9g; expected %.9g, the time of this frame in the other stream",
                     time_s, frame->time_s);
}

/* Parses a line as a frame with sensors and targets. */
static int take_frame(struct reference_stream *reference, const struct frame **other,
                      struct diag *diag)
{
    struct frame *own = &reference->frame;
    frame_order(own);
    unsigned missing = (PART_SENSORS | PART_TARGETS) & ~own->present;
    if (missing != 0)
        return diag_fail(diag, DIAG_DATA, "%s: missing; expected in both streams",
                         frame_part_name(missing & -missing));
    *other = own;
    return frame_check(own, ~0U, diag);
}

int reference_stream_frame(struct reference_stream *reference, const struct frame *frame,
                           const struct frame **other, struct diag *diag)
{
    int found = find(reference, frame, diag);
    if (found <= 0)
        return found;
    if (take_frame(reference, other, diag) == 0 && check_time(frame, (*other)->time_s, diag) == 0 &&
        (*other)->seed != frame->seed)
        diag_fail(diag, DIAG_DATA,
                  "seed: %" PRIu64 "; expected %" PRIu64 ", as in the other stream", (*other)->seed,
                  frame->seed);
    if (diag->code != DIAG_OK)
        return reference_stream_prefix(reference, diag);
    return target_score_check(*other, frame, diag) == 0 ? 1 : -1;
}

int reference_stream_next(struct reference_stream *reference, const struct frame **other,
                          struct diag *diag)
{
    int more = read_line(reference, diag);
    if (more < 0 ||
        (more > 0 && (parse(reference, diag) != 0 || take_frame(reference, other, diag) != 0)))
        return reference_stream_prefix(reference, diag);
    return more;
}

int reference_stream_tracks(struct reference_stream *reference, const struct frame *frame,
                            struct track_list *tracks, struct diag *diag)
{
    struct track_list *own = &reference->tracks;
    int found = find(reference, frame, diag);
    if (found <= 0)
        return found;
    if (track_score_order(own, &reference->arena, diag) != 0 ||
        ((own->present & TRACK_TIME) != 0 && check_time(frame, own->time_s, diag) != 0))
        return reference_stream_prefix(reference, diag);
    *tracks = *own;
    return 1;
}

int reference_stream_finish(struct reference_stream *reference, struct diag *diag)
{
    while (reference->first != NULL) {
        struct waiting_line *unmatched = take_line(reference, &reference->first);
        if (skip_line(reference, unmatched->number, unmatched->scene, unmatched->frame, diag) != 0)
            return -1;
    }
    while (!reference->ended)
        if (read_next(reference, NULL, 0, diag) == SEARCH_FAILED)
            return -1;
    return 0;
}
