/* Score differences of two trackers, paired by scene.
 *
 * Both trackers have tracks in the same frames, for instance from the target lists of two chains.
 * The difference in a scene is the mean over its frames; that of the trackers is the mean over
 * scenes. Its 95 % interval is Student's, for scenes that are independent of each other. */
#pragma once

#include "base/intern.h"
#include "base/text.h"
#include "text/field.h"

/* Figures of a frame: GOSPA in metres, and numbers of missed objects, false tracks and switches. */
enum tracker_figure {
    TRACKER_GOSPA,
    TRACKER_MISSED,
    TRACKER_FALSE,
    TRACKER_SWITCHES,
    TRACKER_FIGURES,
};

struct tracker_scene {
    int64_t frames;
    double sums[TRACKER_FIGURES];
};

/* The differences of all scenes. A zeroed one is empty. */
struct tracker_scenes {
    struct intern names; /* a name's number is that of its scene */
    LIST_OF(struct tracker_scene) list;
};

struct tracker_interval {
    double mean, low, high;
};

struct tracker_difference {
    int64_t scenes;
    struct tracker_interval figures[TRACKER_FIGURES];
};

extern const struct record tracker_difference_record;

/* Adds the differences of a frame: the figures of one tracker less those of the other. */
void tracker_difference_add(struct tracker_scenes *scenes, const char *scene,
                            const double one[TRACKER_FIGURES], const double other[TRACKER_FIGURES],
                            struct arena *arena);

/* Refuses fewer than 5 scenes (DIAG_DATA): their intervals would be unreliable. */
int tracker_difference_of(const struct tracker_scenes *scenes,
                          struct tracker_difference *difference, struct diag *diag);

/* Writes a table for people. */
void tracker_difference_table(const struct tracker_difference *difference, struct text *text);
