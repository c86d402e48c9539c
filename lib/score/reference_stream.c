#include "score/reference_stream.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "frame/frame_check.h"
#include "frame/frame_order.h"
#include "frame/frame_text.h"
#include "text/input.h"
#include "text/json_scan.h"

/* Streams of the same scenes agree in time but for how it was written. */
static const double same_time_s = 1e-6;

/* A line that waits. Each is one piece of memory of its own. */
struct waiting {
    struct waiting *next;
    size_t number;
    int64_t frame;
    const char *scene;
    size_t length;
    char *bytes;
};

struct reference_stream {
    struct input *input;
    bool partial, ended;
    size_t number;    /* of the line read last */
    size_t found;     /* of the line found last: */
    const char *line; /* valid until the next is looked for */
    size_t length;
    struct waiting *first, **last;
    struct waiting *taken; /* the one that was taken out last */
    int64_t left, absent;
    struct frame frame;
    struct arena arena, words;
};

struct reference_stream *reference_stream_open(const char *path, bool partial, struct diag *diag)
{
    struct input *input = input_open(path, diag);
    if (input == NULL) {
        diag_prefix(diag, "%s: ", path);
        return NULL;
    }
    struct reference_stream *counterpart = memory_get(sizeof *counterpart);
    *counterpart = (struct reference_stream){.input = input, .partial = partial};
    counterpart->last = &counterpart->first;
    counterpart->frame.arena = &counterpart->arena;
    return counterpart;
}

void reference_stream_close(struct reference_stream *counterpart)
{
    if (counterpart == NULL)
        return;
    free(counterpart->taken);
    for (struct waiting *line = counterpart->first, *next; line != NULL; line = next) {
        next = line->next;
        free(line);
    }
    arena_free(&counterpart->arena);
    arena_free(&counterpart->words);
    input_close(counterpart->input);
    free(counterpart);
}

static int place(const struct reference_stream *counterpart, struct diag *diag)
{
    if (diag->code == DIAG_NO_INPUT) /* a folder has no lines */
        return diag_prefix(diag, "%s: ", input_name(counterpart->input));
    return diag_prefix(diag, "%s:%zu: ", input_name(counterpart->input), counterpart->found);
}

int64_t reference_stream_left(const struct reference_stream *counterpart)
{
    return counterpart->left;
}

int64_t reference_stream_absent(const struct reference_stream *counterpart)
{
    return counterpart->absent;
}

/* Which scene and frame a line is of. */
struct key {
    const char *scene;
    double frame; /* -1: not there */
};

static int read_member(struct json_scan *scan, struct key *key)
{
    struct json_string name, text;
    if (json_scan_string(scan, &name) != 0)
        return -1;
    if (!json_scan_take(scan, ':'))
        return json_scan_unexpected(scan, "':'");
    if (name.length == 5 && memcmp(name.text, "scene", 5) == 0) {
        if (json_scan_peek(scan) != '"')
            return json_scan_unexpected(scan, "a scene's name");
        if (json_scan_string(scan, &text) != 0)
            return -1;
        key->scene = arena_text(scan->arena, text.text, text.length);
        return 0;
    }
    if (name.length == 5 && memcmp(name.text, "frame", 5) == 0) {
        if (strchr("0123456789", json_scan_peek(scan)) == NULL)
            return json_scan_unexpected(scan, "a frame's number");
        return json_scan_number(scan, &key->frame);
    }
    return json_scan_value(scan, &text);
}

/* Reads no further than both members: whoever takes the line reads all of it. */
static int read_key(struct reference_stream *counterpart, struct key *key, struct diag *diag)
{
    arena_clear(&counterpart->words);
    const char *line = counterpart->line;
    struct json_scan scan = {line, line + counterpart->length, &counterpart->words, diag};
    *key = (struct key){.frame = -1};
    if (!json_scan_take(&scan, '{'))
        return json_scan_unexpected(&scan, "an object");
    for (bool more = true; more && (key->scene == NULL || key->frame < 0);
         more = json_scan_take(&scan, ','))
        if (read_member(&scan, key) != 0)
            return -1;
    if (key->scene == NULL)
        return diag_fail(diag, DIAG_DATA, "scene: missing; expected a name");
    if (key->frame < 0 || key->frame != floor(key->frame) || key->frame > 0x1p53)
        return diag_fail(diag, DIAG_DATA, "frame: %s; expected the number of a frame",
                         key->frame < 0 ? "missing" : "not a whole number");
    return 0;
}

static void hold(struct reference_stream *counterpart, const struct key *key)
{
    size_t scene = strlen(key->scene) + 1;
    struct waiting *line = memory_get(sizeof *line + scene + counterpart->length);
    char *text = (char *)(line + 1);
    *line = (struct waiting){.number = counterpart->number,
                             .frame = (int64_t)key->frame,
                             .scene = text,
                             .length = counterpart->length,
                             .bytes = text + scene};
    memcpy(text, key->scene, scene);
    memcpy(line->bytes, counterpart->line, line->length);
    *counterpart->last = line;
    counterpart->last = &line->next;
}

static int leave(struct reference_stream *counterpart, size_t number, const char *scene,
                 int64_t frame, struct diag *diag)
{
    counterpart->left++;
    if (counterpart->partial)
        return 0;
    counterpart->found = number;
    diag_fail(diag, DIAG_DATA, "frame %lld of scene \"%s\" is not in the stream", (long long)frame,
              scene);
    return place(counterpart, diag);
}

/* Takes a line out of those that wait: it goes with the next call. */
static struct waiting *take(struct reference_stream *counterpart, struct waiting **at)
{
    struct waiting *line = *at;
    *at = line->next;
    if (counterpart->last == &line->next)
        counterpart->last = at;
    free(counterpart->taken);
    counterpart->taken = line;
    return line;
}

enum search { SEARCH_FAILED, SEARCH_ON, SEARCH_FOUND, SEARCH_PAST };

/* Among the lines that wait. */
static enum search look(struct reference_stream *counterpart, const char *scene, int64_t frame,
                        struct diag *diag)
{
    for (struct waiting **at = &counterpart->first; *at != NULL;) {
        if (strcmp((*at)->scene, scene) != 0) {
            at = &(*at)->next;
            continue;
        }
        if ((*at)->frame > frame)
            return SEARCH_PAST;
        struct waiting *line = take(counterpart, at);
        if (line->frame == frame) {
            counterpart->found = line->number;
            counterpart->line = line->bytes;
            counterpart->length = line->length;
            return SEARCH_FOUND;
        }
        if (leave(counterpart, line->number, line->scene, line->frame, diag) != 0)
            return SEARCH_FAILED;
    }
    return SEARCH_ON;
}

/* The line that comes next; one that is not wanted waits, or is left. Without a scene none is. */
static enum search read_next(struct reference_stream *counterpart, const char *scene, int64_t frame,
                             struct diag *diag)
{
    struct key key;
    counterpart->found = ++counterpart->number;
    int more = input_line(counterpart->input, FRAME_TEXT_SIZE, &counterpart->line,
                          &counterpart->length, diag);
    counterpart->ended = more == 0;
    if (more < 0 || (more > 0 && read_key(counterpart, &key, diag) != 0)) {
        place(counterpart, diag);
        return SEARCH_FAILED;
    }
    if (more == 0)
        return SEARCH_PAST;
    bool same = scene != NULL && strcmp(key.scene, scene) == 0;
    if (same && (int64_t)key.frame == frame)
        return SEARCH_FOUND;
    if (scene == NULL || (same && key.frame < (double)frame)) {
        int left = leave(counterpart, counterpart->number, key.scene, (int64_t)key.frame, diag);
        return left == 0 ? SEARCH_ON : SEARCH_FAILED;
    }
    hold(counterpart, &key);
    return same ? SEARCH_PAST : SEARCH_ON;
}

/* Finds the line for a scene and frame: 1, 0 if there is none, -1. */
static int find(struct reference_stream *counterpart, const struct frame *frame, struct diag *diag)
{
    enum search search = look(counterpart, frame->scene, frame->frame, diag);
    while (search == SEARCH_ON)
        search = counterpart->ended ? SEARCH_PAST
                                    : read_next(counterpart, frame->scene, frame->frame, diag);
    if (search != SEARCH_PAST)
        return search == SEARCH_FOUND ? 1 : -1;
    counterpart->absent++;
    if (counterpart->partial)
        return 0;
    return diag_fail(diag, DIAG_DATA, "frame: %s has no frame %lld of scene \"%s\"",
                     input_name(counterpart->input), (long long)frame->frame, frame->scene);
}

/* Refuses streams of other scenes under the same names. */
static int check_time(const struct frame *frame, double time_s, struct diag *diag)
{
    if (fabs(time_s - frame->time_s) <= same_time_s)
        return 0;
    return diag_fail(
        diag, DIAG_DATA,
        "time_s: %.9g; that frame of the stream is at %.9g s: are these the same scenes?", time_s,
        frame->time_s);
}

int reference_stream_frame(struct reference_stream *counterpart, const struct frame *frame,
                           unsigned sections, const struct frame **other, struct diag *diag)
{
    int found = find(counterpart, frame, diag);
    if (found <= 0)
        return found;
    struct frame *own = &counterpart->frame;
    if (frame_text_read(counterpart->line, counterpart->length, own, diag) != 0)
        return place(counterpart, diag);
    frame_order(own);
    unsigned missing = sections & ~own->present;
    if (missing != 0)
        diag_fail(diag, DIAG_DATA, "%s: missing; there is nothing to compare with",
                  frame_section_name(missing & -missing));
    if (missing != 0 || frame_check(own, diag) != 0 || check_time(frame, own->time_s, diag) != 0)
        return place(counterpart, diag);
    *other = own;
    return 1;
}

int reference_stream_tracks(struct reference_stream *counterpart, const struct frame *frame,
                            struct track_list *tracks, struct diag *diag)
{
    int found = find(counterpart, frame, diag);
    if (found <= 0)
        return found;
    field_clear(&track_list_record, tracks);
    if (frame_text_read_record(counterpart->line, counterpart->length, &track_list_record, tracks,
                               frame->arena, diag) != 0 ||
        track_order(tracks, frame->arena, diag) != 0 ||
        ((tracks->present & TRACK_TIME) != 0 && check_time(frame, tracks->time_s, diag) != 0))
        return place(counterpart, diag);
    return 1;
}

int reference_stream_finish(struct reference_stream *counterpart, struct diag *diag)
{
    while (counterpart->first != NULL) {
        struct waiting *left = take(counterpart, &counterpart->first);
        if (leave(counterpart, left->number, left->scene, left->frame, diag) != 0)
            return -1;
    }
    while (!counterpart->ended)
        if (read_next(counterpart, NULL, 0, diag) == SEARCH_FAILED)
            return -1;
    return 0;
}
