/* A sample of a stream's frames, spread evenly over it.
 *
 * All frames are kept until there are more than `most`. Then one of each stretch of 2 is kept, of
 * 4, of 8 and so on: drawn by its place in the stream alone, so that no sensor's cycle is in step
 * with the sample. Frames are kept as lines of their objects and reflectors. */
#pragma once

#include "base/intern.h"
#include "frame/frame.h"

struct sampled_frame {
    const char *line; /* without its newline */
    size_t length;
    uint64_t seed;
    int64_t place;       /* in the stream, from 0 */
    size_t scene, block; /* numbers; the block is set by frame_sample_divide */
};

/* Zeroed but for arena and most before the first frame. */
struct frame_sample {
    struct arena *arena;
    int64_t most; /* of the frames that are kept; at least 1 */
    int64_t seen, stride;
    LIST_OF(struct sampled_frame) list;
    struct intern names;   /* of scenes, with their seeds */
    size_t scenes, blocks; /* of the frames that are kept; set by frame_sample_divide */
};

int frame_sample_add(struct frame_sample *sample, const struct frame *frame, struct diag *diag);

/* After the last frame: divides the sample into blocks. A block is a scene if there are 10 or more;
 * else each scene is cut into stretches, 10 in all or a few more, or as many as there are frames.
 */
void frame_sample_divide(struct frame_sample *sample);

/* Reads a frame of the sample, in canonical order and checked. */
int frame_sample_read(const struct sampled_frame *sampled, struct frame *frame, struct diag *diag);
