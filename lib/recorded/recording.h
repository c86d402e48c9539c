/* Frames of a recording: a scene for each ego.
 *
 * All sources of recorded traffic open a reader of their format (recorded_row.h); a recording makes
 * frames of its rows. */
#pragma once

#include "geometry/neighbour_grid.h"
#include "recorded/resampling.h"

/* Options that all recordings share. */
struct recording_options {
    const char *ego, *scene;
    double radius_m, rate_hz; /* -1: not given */
    double from_s, to_s;      /* -9e9 and 9e9: not given */
    const char *class_map, *class_default, *conditions;
};

extern const struct record recording_options_record;

/* Fields of a stage whose state begins with a struct recording: the source with the shared options.
 */
#define RECORDING_SOURCE(help)                                                                     \
    {FIELD_NAME_OF(struct recording, source, help)},                                               \
    {                                                                                              \
        OPTIONAL_RECORD(struct recording, options, &recording_options_record, "")                  \
    }

/* An ego and its present visit. */
struct recorded_ego {
    const char *id;
    const char *scene;      /* of the visit */
    int64_t since_ns;       /* time when the visit began */
    int64_t visits, frames; /* number of visits so far, and of frames of the present one */
    size_t step;            /* the last one that had it */
    size_t missed, jumps;   /* steps without it between visits; visits that begin without such */
    bool moves;
    struct vec2 origin_m;
};

struct recording {
    /* Set by the caller. source is the path, for messages and names of scenes. */
    const char *source;
    struct recording_options options;
    bool live;                   /* no step waits for the next one (recorded_steps.h) */
    const char *host;            /* id of the ego without --ego; NULL: the source names none */
    struct recorded_types types; /* of SUMO */
    /* Set by the recording. */
    const char *name; /* of scenes, before the ego's name */
    bool all;         /* every vehicle is an ego */
    int64_t from_ns;
    struct intern wanted; /* ids of egos, unless all are egos */
    struct recorded_steps steps;
    struct resampling resampling;
    struct intern ids;                 /* of egos so far */
    LIST_OF(struct recorded_ego) egos; /* by the number of the id */
    struct conditions conditions;      /* changed by the options */
    struct arena *arena;
    const struct recorded_step *step; /* the present step */
    size_t steps_taken;
    bool moves; /* anybody, so far */
    struct arena step_arena;
    LIST_OF(uint32_t) step_egos; /* places of egos in the step's states */
    size_t ego;                  /* next one of step_egos */
    struct neighbour_grid grid;
    struct intern apart; /* ids of bodies that were left out, as they are on another road */
    size_t apart_frames; /* number of frames in which one was */
};

/* Takes over the reader, which is closed with the recording and after a failure. */
int recording_open(struct recording *recording, struct recorded_reader reader, struct arena *arena,
                   struct diag *diag);

/* Reads --conditions, for conditions_change. */
int recording_conditions(const struct recording_options *options, struct conditions *changes,
                         struct arena *arena, struct diag *diag);

/* The name of a source's scenes: "tracks" of ../tracks.csv.gz. */
const char *recording_name(const char *source, struct arena *arena);

/* Fills header and objects of the next frame: 1; 0 at the end; -1 after a message. */
int recording_next(struct recording *recording, struct frame *frame, struct diag *diag);

/* Refuses the last frame if an object is out of the bounds of its record, for instance too far from
 * the origin; the message names its place in the file. */
int recording_check(const struct recording *recording, const struct frame *frame,
                    struct diag *diag);

/* The release of a stage whose state is or begins with a struct recording. */
void recording_close(void *recording);
