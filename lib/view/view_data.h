/* A stream's frames as tables of columns, for glint-view. They come with another stream's targets
 * and a tracker's tracks, where these are asked for. Columns of small numbers and a table of names
 * take the place of a tree: 10,000 frames of 30 objects are some 30 MB and open at once.
 *
 * Rows of one table own rows of another, by count and in order: each frame owns objects and scans,
 * each scan owns targets, fates and details (view_losses.h), each target owns contributors.
 * Coordinates are relative to the place of the scene's ego in its first frame.
 *
 * Truths are the targets of the other stream, each with the number of the listed target that
 * glint-score pairs it with; a scan that one of the streams did not make has none. Missed objects
 * are tracks without an id and a place. Frames that the other stream lacks have neither, and say
 * so. */
#pragma once

#include "score/reference_stream.h"
#include "view/view_frame.h"
#include "view/view_losses.h"

/* A line or band that stays on the ground. The page draws each kind as page/ground.js says. */
struct view_ground {
    const char *kind;
    double from_x_m, from_y_m, to_x_m, to_y_m;
    double width_m; /* 0: a line */
};

struct view_scene {
    int64_t name, ego, suite; /* numbers in the table of names */
    uint64_t seed;
    int64_t first_frame;
    double start_s;
    double anchor_x_m, anchor_y_m;
    LIST_OF(struct view_ground) ground;
    bool ended;
    bool compared, tracked; /* the other streams have a frame of it */
};

struct view_data {
    struct arena *arena;
    struct view_models models;
    struct intern scene_keys, effect_sets;
    LIST_OF(struct view_scene) scenes;
    LIST_OF(struct sensor_view) sensors;
    struct view_columns columns;
    struct view_losses losses;
    struct reference_stream *truth, *tracks; /* the other streams; NULL: not asked for */
    struct track_memory memory;
};

/* Begins without frames; all memory is the arena's. */
void view_data_begin(struct view_data *data, struct arena *arena);

/* Adds a frame of any scene, in canonical order, and what the other streams have for it. Memory
 * that it does not keep comes from the frame's arena. Refuses (DIAG_DATA) what glint-score and
 * glint-score-tracks refuse. */
int view_data_add(struct view_data *data, const struct frame *frame, struct diag *diag);

/* Reads the other streams on to their ends. Refuses (DIAG_DATA) another stream that has no frame of
 * a scene: it shows something else. */
int view_data_finish(struct view_data *data, struct diag *diag);
