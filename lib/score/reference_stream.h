/* A second stream beside the one that a stage reads: its line for the same scene and frame.
 *
 * The two may interleave their scenes differently; within a scene both ascend. Lines of other
 * scenes that are passed on the way wait in memory until they are asked for, so streams in the same
 * order take no more than a line. Lines are JSON objects with the members `scene` and `frame`. */
#ifndef REFERENCE_STREAM_H
#define REFERENCE_STREAM_H

#include "frame/frame.h"
#include "score/track.h"

struct reference_stream;

/* Opens the file, or standard input for "-". With partial, frames that only one side has are
 * counted; without, they are errors. NULL after a message. */
struct reference_stream *reference_stream_open(const char *path, bool partial, struct diag *diag);
void reference_stream_close(struct reference_stream *counterpart);

/* The line for this frame's scene and number, read as a frame that has these sections and the same
 * time, in canonical order and checked. It belongs to the counterpart and stays until the next
 * call. 1, 0 if there is none, -1. */
int reference_stream_frame(struct reference_stream *counterpart, const struct frame *frame,
                           unsigned sections, const struct frame **other, struct diag *diag);

/* The same, read as tracks, in the order of their ids; all lies in the frame's arena. */
int reference_stream_tracks(struct reference_stream *counterpart, const struct frame *frame,
                            struct track_list *tracks, struct diag *diag);

/* Reads on to the end. Without partial, refuses lines that nobody asked for. */
int reference_stream_finish(struct reference_stream *counterpart, struct diag *diag);

/* How many lines nobody asked for, as far as is known; and how many frames had no line. */
int64_t reference_stream_left(const struct reference_stream *counterpart);
int64_t reference_stream_absent(const struct reference_stream *counterpart);

#endif
