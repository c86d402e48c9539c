/* --complete: the frames of each scene ascend from 0 without a gap and end with its last one.
 * Scenes may interleave. Every scene is remembered to the end, as a closed one must not come back:
 * about a hundred bytes each, and one look at a table per frame. */
#ifndef FRAME_SEQUENCE_H
#define FRAME_SEQUENCE_H

#include "base/intern.h"
#include "frame/frame.h"

struct scene_progress {
    int64_t frame; /* the last one seen */
    bool closed;
};

/* Zeroed, it has seen nothing. */
struct frame_sequence {
    struct intern names;
    LIST_OF(struct scene_progress) scenes; /* by number of the name */
};

/* Both return 0, or -1 after a message (DIAG_DATA). The arena keeps the names. */
int frame_sequence_follow(struct frame_sequence *completeness, const struct frame *frame,
                          struct arena *arena, struct diag *diag);
int frame_sequence_end(const struct frame_sequence *completeness, struct diag *diag);

#endif
