/* What glint-summary counts: a stream's targets, losses or objects. */
#pragma once

#include "base/intern.h"
#include "base/text.h"
#include "frame/frame.h"

/* A name, and how often it was counted; of a sensor also its scans. */
struct name_count {
    const char *name;
    int64_t count, scans;
};

struct name_counts {
    struct intern names;
    LIST_OF(struct name_count) list; /* by the number of the name */
    int64_t sum;                     /* of all counts */
};

/* Zeroed but for the arena before the first frame. */
struct stream_counts {
    struct arena *arena; /* for the names that are counted */
    bool traffic;        /* no frame was seen by sensors */
    struct name_counts sensors, classes, others, outcomes, objects;
    int64_t appearances; /* of objects in frames */
    int64_t frames, scenes, scans, merged;
    double seconds, farthest_m;
    /* Scenes whose last frame is still to come, and their objects so far. */
    struct intern open_scenes, open_objects;
    int64_t open;
    struct arena open_names; /* the caller frees it at the end */
};

/* Counts a frame: its targets by sensor and by class of the strongest contributor, and its losses
 * by reason; or the objects of traffic by class, each once in its scene. Refuses frames that have
 * sensors without targets (DIAG_DATA). */
int stream_counts_add(struct stream_counts *counts, const struct frame *frame, struct diag *diag);

/* Writes the counts as lines with shares in per cent, the most frequent names first. */
void stream_counts_write(struct stream_counts *counts, struct text *text);
