/* Completeness of the scenes in a stream of frames.
 *
 * With --complete the frames of each scene must ascend from 0 without a gap and end with its last
 * frame. Scenes may interleave. Every scene is remembered to the end of the stream, as a scene must
 * not come back after its last frame: about a hundred bytes for each. */
#ifndef FRAME_SEQUENCE_H
#define FRAME_SEQUENCE_H

#include "base/intern.h"
#include "frame/frame.h"

struct scene_progress {
    int64_t frame; /* number of the latest frame */
    bool closed;   /* was that the scene's last? */
};

/* All zero before the first frame. */
struct frame_sequence {
    struct intern names;
    LIST_OF(struct scene_progress) scenes; /* by the number of the scene's name */
};

/* Notes a frame. Fails with DIAG_DATA if it is not the next of its scene. Names are kept in the
 * arena. */
int frame_sequence_follow(struct frame_sequence *sequence, const struct frame *frame,
                          struct arena *arena, struct diag *diag);

/* Fails with DIAG_DATA if a scene lacks its last frame, or if there was no frame at all, as a
 * source that fails leaves none. */
int frame_sequence_end(const struct frame_sequence *sequence, struct diag *diag);

#endif
