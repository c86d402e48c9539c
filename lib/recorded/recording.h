/* Frames of a recording: a scene for each ego.
 *
 * This is what all sources of recorded traffic share: they open a reader of their format
 * (recorded_row.h), and a recording makes frames of what it reads. */
#pragma once

#include "geometry/neighbour_grid.h"
#include "recorded/resampling.h"

/* Options that all recordings share. */
struct recording_options {
    const char *ego, *scene;
    double radius_m, rate_hz; /* -1: not given */
    double from_s, to_s;      /* -9e9 and 9e9: not given */
    const char *class_map, *class_default, *conditions;
    LIST_OF(const char *) types; /* files; RECORDING_TYPES */
};

extern const struct record recording_options_record;

/* Fields of a source whose state begins with a struct recording: what it plays with the options
 * that all recordings share, and types, for sources that play SUMO. */
#define RECORDING_SOURCE(help)                                                                     \
    {FIELD_NAME_OF(struct recording, source, help)},                                               \
    {                                                                                              \
        OPTIONAL_RECORD(struct recording, options, &recording_options_record, "")                  \
    }
#define RECORDING_TYPES                                                                            \
    {                                                                                              \
        .name = "types", .kind = FIELD_NAMES, .offset = offsetof(struct recording, options.types), \
        .help =                                                                                    \
            "a file of SUMO's routes with vTypes; may be given several times; absent: SUMO's own " \
            "sizes of classes",                                                                    \
        .word = "FILE", FIELD_OPTIONAL                                                             \
    }

/* What there was of an ego so far. */
struct recorded_ego {
    const char *id;
    const char *scene; /* of its visit now */
    int64_t since_ns;  /* when that began */
    int64_t visits, frames;
    struct vec2 origin_m;
};

struct recording {
    /* What the caller sets. source is the path, for messages and names of scenes. */
    const char *source;
    struct recording_options options;
    bool live; /* nothing waits for the next step (recorded_steps.h) */
    /* The rest is the recording's own. */
    const char *name; /* of scenes, before the ego's */
    bool all;         /* is every vehicle an ego? */
    int64_t from_ns;
    struct intern wanted; /* ids of egos, unless all are */
    struct recorded_steps steps;
    struct resampling resampling;
    struct intern ids;                 /* of egos that were there */
    LIST_OF(struct recorded_ego) egos; /* by the number of the id */
    struct conditions conditions;      /* that the options change */
    struct arena *arena;
    const struct recorded_step *step; /* whose frames are being made */
    struct arena step_arena;
    LIST_OF(uint32_t) step_egos; /* places in the step's states */
    size_t ego;                  /* of step_egos, whose frame is next */
    struct neighbour_grid grid;
};

/* Takes over the reader, which is closed with the recording, and after a failure. What the
 * recording keeps lies in the arena. */
int recording_open(struct recording *recording, struct recorded_reader reader, struct arena *arena,
                   struct diag *diag);

/* Reads --conditions, for conditions_change. */
int recording_conditions(const struct recording_options *options, struct conditions *changes,
                         struct arena *arena, struct diag *diag);

/* The part of a source's name that names its scenes: "tracks" of ../tracks.csv.gz. */
const char *recording_name(const char *source, struct arena *arena);

/* Fills header and objects of the next frame: 1; 0 at the end; -1 after a message. */
int recording_next(struct recording *recording, struct frame *frame, struct diag *diag);

/* Refuses the frame that was made last if an object is out of the bounds of its record, for
 * instance too far from the origin; the message names its place in the file. */
int recording_check(const struct recording *recording, const struct frame *frame,
                    struct diag *diag);

/* Of a struct recording; the release of a stage whose state begins with one. */
void recording_close(void *recording);
