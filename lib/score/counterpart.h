/* A second stream beside the one that a stage reads: its line for the same scene and frame.
 *
 * The two may interleave their scenes differently; within a scene both ascend. Lines of other
 * scenes that are passed on the way wait in memory until they are asked for, so streams in the same
 * order take no more than a line. Lines are JSON objects with the members `scene` and `frame`. */
#ifndef COUNTERPART_H
#define COUNTERPART_H

#include "frame.h"
#include "track.h"

struct counterpart;

/* Opens the file, or standard input for "-". With partial, frames that only one side has are
 * counted; without, they are errors. NULL after a message. */
struct counterpart *counterpart_open(const char *path, bool partial, struct diag *diag);
void counterpart_close(struct counterpart *counterpart);

/* The line for this frame's scene and number, read as a frame that has these sections and the same
 * time, in canonical order and checked. It belongs to the counterpart and stays until the next
 * call. 1, 0 if there is none, -1. */
int counterpart_frame(struct counterpart *counterpart, const struct frame *frame, unsigned sections,
                      const struct frame **other, struct diag *diag);

/* The same, read as tracks, in the order of their ids; all lies in the frame's arena. */
int counterpart_tracks(struct counterpart *counterpart, const struct frame *frame,
                       struct track_list *tracks, struct diag *diag);

/* Reads on to the end. Without partial, refuses lines that nobody asked for. */
int counterpart_finish(struct counterpart *counterpart, struct diag *diag);

/* How many lines nobody asked for, as far as is known; and how many frames had no line. */
int64_t counterpart_left(const struct counterpart *counterpart);
int64_t counterpart_absent(const struct counterpart *counterpart);

#endif
