/* A sample of a stream's frames, spread evenly over it.
 *
 * All frames are kept until there are twice as many as `most`. Then one frame is kept of each
 * stretch of 2, later of 4, of 8 and so on, and in the end as many as are asked for. Which frame of
 * its stretch is drawn by its place alone, so that no sensor's cycle is in step with the sample.
 * Frames are kept as lines of their objects and, if they are there, reflectors. */
#pragma once

#include "base/intern.h"
#include "frame/frame.h"

struct sampled_frame {
    const char *line; /* without its newline */
    size_t length;
    uint64_t seed;
    int64_t frame; /* its number in the scene */
    int64_t place; /* in the stream, from 0 */
    size_t scene;  /* number in frame_sample.names */
};

/* Zeroed but for arena and most before the first frame. */
struct frame_sample {
    struct arena *arena;
    int64_t most; /* at least 1 */
    int64_t seen, stride;
    LIST_OF(struct sampled_frame) list;
    struct intern names; /* of scenes, with their seeds */
};

int frame_sample_add(struct frame_sample *sample, const struct frame *frame, struct diag *diag);

/* After the last frame: keeps exactly so many frames, one of each stretch of the sample, or all if
 * there are no more. */
void frame_sample_thin(struct frame_sample *sample, int64_t most);
