/* Frames packed for the page of glint-view: columns of small numbers and a table of names, instead
 * of a tree. 10,000 frames of 30 objects are some 30 MB and open at once.
 *
 * Rows of a table belong to rows of another by count, in order: each frame has so many objects and
 * scans, each scan so many targets, fates and details, each target so many contributors. What a
 * scan lost is told by object: its fate is a number into the patterns, each a list of reflectors
 * and reasons, because most objects are lost in the same way for many frames; details are what
 * does change (who blocked, how much was missing). Coordinates are relative to the place of the
 * scene's ego in its first frame. */
#ifndef VIEW_DATA_H
#define VIEW_DATA_H

#include "base/intern.h"
#include "frame/frame.h"
#include "view/view_columns.h"
#include "view/view_frame.h"

struct view_scene {
    uint32_t name, ego, suite; /* names */
    int64_t first_frame;
    double start_s;
    double anchor_x_m, anchor_y_m;
    bool account, ended;
};

struct view_data {
    struct arena *arena;
    struct view_models models;
    struct intern names, scene_names, patterns, effect_sets;
    LIST_OF(struct view_scene) scenes;
    LIST_OF(struct sensor_view) sensors;
    struct view_columns columns;
};

/* All memory is the arena's. */
void view_data_begin(struct view_data *data, struct arena *arena);

/* Takes a frame in canonical order, of any scene; uses its arena for what it need not keep. */
void view_data_add(struct view_data *data, const struct frame *frame);

#endif
