/* A second stream beside the one that a stage reads: its line for the same scene and frame.
 *
 * The two may interleave their scenes differently; within a scene both ascend. Lines of other
 * scenes that are passed on the way wait in memory until they are asked for, so streams in the same
 * order take no more than a line. Lines are JSON objects with the members `scene` and `frame`. */
#ifndef COUNTERPART_H
#define COUNTERPART_H

#include "frame.h"

struct counterpart;

/* Opens the file, or standard input for "-". With partial, frames that only one side has are
 * counted; without, they are errors. NULL after a message. */
struct counterpart *counterpart_open(const char *path, bool partial, struct diag *diag);
void counterpart_close(struct counterpart *counterpart);

/* The line for a scene and frame, valid until the next call: 1, 0 if there is none, -1. */
int counterpart_line(struct counterpart *counterpart, const char *scene, int64_t frame,
                     const char **line, size_t *length, struct diag *diag);

/* That line as a frame, in canonical order and checked, which has these sections and is of the same
 * time. It belongs to the counterpart and stays until the next call. */
int counterpart_frame(struct counterpart *counterpart, const struct frame *frame, unsigned sections,
                      const struct frame **other, struct diag *diag);

/* Puts the place of the line last found in front of a message: -1. */
int counterpart_prefix(const struct counterpart *counterpart, struct diag *diag);

/* Refuses a time that is not the frame's: streams of other scenes under the same names. */
int counterpart_check_time(const struct frame *frame, double time_s, struct diag *diag);

/* Reads on to the end. Without partial, refuses lines that nobody asked for. */
int counterpart_finish(struct counterpart *counterpart, struct diag *diag);

/* How many lines nobody asked for, as far as is known; and how many frames had no line. */
int64_t counterpart_left(const struct counterpart *counterpart);
int64_t counterpart_absent(const struct counterpart *counterpart);

#endif
