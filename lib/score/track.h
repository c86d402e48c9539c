/* What a tracker says of one frame: a line of its own small format. */
#ifndef TRACK_H
#define TRACK_H

#include "text/field.h"

/* Where the tracker has an object, in the frame's coordinates and as frames give objects: the
 * centre of its box and that one's velocity over ground, relative to the frame's origin. */
struct track {
    const char *id; /* the same as long as the tracker takes it for the same object */
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
    unsigned present; /* TRACK_TIME: time_s is there */
};

extern const struct record track_list_record;

/* Brings the tracks into the order of their ids; refuses an id that stands twice (DIAG_DATA). */
int track_order(struct track_list *list, struct arena *arena, struct diag *diag);

#endif
