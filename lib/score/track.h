/* Line format for a tracker's tracks in one frame. */
#pragma once

#include "text/field.h"

/* A track, in the coordinates of the frame's objects: the centre of the object's box, relative to
 * the frame's origin, and the velocity of that centre over ground. */
struct track {
    const char *id; /* constant while the tracker takes it for the same object */
    double x_m, y_m, vx_mps, vy_mps;
    const char *extra;
};

enum { TRACK_TIME = 1 << 0 };

struct track_list {
    const char *scene;
    int64_t frame;
    double time_s;
    LIST_OF(struct track) tracks;
    const char *extra;
    unsigned present; /* TRACK_TIME: the line has time_s */
};

extern const struct record track_list_record;

/* Sorts the tracks by id; refuses an id of two tracks (DIAG_DATA). */
int track_order(struct track_list *list, struct arena *arena, struct diag *diag);
