/* Order and completeness of scenes in a stream of frames.
 *
 * A scene is known by its name and its seed. With --complete the frames of each scene must ascend
 * from 0 without a gap and end with its last frame. Scenes may interleave. A scene must not come
 * back after its last frame, so that every scene takes about 350 bytes to the end of the stream. */
#pragma once

#include "base/intern.h"
#include "frame/frame.h"

/* Where a frame was read. */
struct frame_place {
    const char *file; /* lives as long as the sequence */
    size_t line;
};

struct scene_progress {
    const char *name;
    uint64_t seed;
    int64_t frame;            /* number of the latest frame */
    bool closed;              /* was that the scene's last? */
    struct frame_place begin; /* of the scene's first frame in the stream */
};

/* All zero before the first frame. */
struct frame_sequence {
    struct intern names, keys;             /* of scenes; a key is a name's number and a seed */
    LIST_OF(struct scene_progress) scenes; /* by the number of the scene's key */
    struct intern frames;                  /* a scene's number and a frame's */
    LIST_OF(struct frame_place) places;    /* by the number of the frame */
};

/* Notes a frame, in memory of the arena. Fails with DIAG_DATA if it is not the next of its scene
 * (follow), not behind the latest (ascend), or there already (once, which takes some hundred bytes
 * a frame). The message names the place of the earlier frame; the caller puts the frame's own in
 * front. */
int frame_sequence_follow(struct frame_sequence *sequence, const struct frame *frame,
                          struct frame_place place, struct arena *arena, struct diag *diag);
int frame_sequence_ascend(struct frame_sequence *sequence, const struct frame *frame,
                          struct frame_place place, struct arena *arena, struct diag *diag);
int frame_sequence_once(struct frame_sequence *sequence, const struct frame *frame,
                        struct frame_place place, struct arena *arena, struct diag *diag);

/* Fails with DIAG_DATA if scenes of one name came with two seeds. */
int frame_sequence_one_seed(const struct frame_sequence *sequence, struct diag *diag);

/* Fails with DIAG_DATA if a scene lacks its last frame, or if there was no frame at all. */
int frame_sequence_end(const struct frame_sequence *sequence, struct diag *diag);
