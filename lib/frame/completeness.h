/* --complete: the frames of each scene ascend from 0 without a gap and end with its last one.
 * Scenes may interleave. Every scene is remembered to the end, as a closed one must not come back:
 * about a hundred bytes each, and one look at a table per frame. */
#ifndef COMPLETENESS_H
#define COMPLETENESS_H

#include "frame.h"
#include "pool.h"

struct scene_progress {
    int64_t frame; /* the last one seen */
    bool closed;
};

/* Zeroed, it has seen nothing. */
struct completeness {
    struct pool names;
    LIST_OF(struct scene_progress) scenes; /* by number of the name */
};

/* Both return 0, or -1 after a message (DIAG_DATA). The arena keeps the names. */
int completeness_follow(struct completeness *completeness, const struct frame *frame,
                        struct arena *arena, struct diag *diag);
int completeness_end(const struct completeness *completeness, struct diag *diag);

#endif
