/* Second stream of frames, matched by scene and frame number.
 *
 * The second stream and the one that a stage reads may interleave their scenes differently; within
 * a scene both ascend. Lines that come before they are needed wait in memory, so streams in the
 * same order take no more than a line. */
#pragma once

#include "frame/frame.h"
#include "score/track_score.h"
#include "text/input.h"

struct reference_stream;

/* Opens the file, or standard input for "-", whose lines are frames (frame_record) or tracks
 * (track_list_record). With partial true either stream may have frames that the
 * other lacks; else they are errors. The pause comes before a wait for a line. NULL after a
 * message. */
struct reference_stream *reference_stream_open(const char *path, const struct record *record,
                                               bool partial, struct input_pause pause,
                                               struct diag *diag);
void reference_stream_close(struct reference_stream *reference);

/* Finds the line for this frame's scene and number and reads it as a frame with sensors and
 * targets, in canonical order and checked. Refuses another time, another seed, and sensors that
 * cannot be compared (target_score_check). *other belongs to the stream and stays until the next
 * call. Returns 1, 0 if there is no such line, -1 after a message. */
int reference_stream_frame(struct reference_stream *reference, const struct frame *frame,
                           const struct frame **other, struct diag *diag);

/* Reads the next line as a frame with sensors and targets, whatever its scene: for streams that are
 * read alone, never between calls of the other functions. Returns 1, 0 at the end, -1 after a
 * message. */
int reference_stream_next(struct reference_stream *reference, const struct frame **other,
                          struct diag *diag);

/* Puts the place of the line found last in front of a message: for what callers refuse in it. */
int reference_stream_prefix(const struct reference_stream *reference, struct diag *diag);

/* reference_stream_next for a stream of tracks, in the order of their ids. */
int reference_stream_tracks(struct reference_stream *reference, const struct frame *frame,
                            struct track_list *tracks, struct diag *diag);

/* Reads on to the end. Unless partial, refuses lines that matched no frame. */
int reference_stream_finish(struct reference_stream *reference, struct diag *diag);

/* Refuses (DIAG_DATA) the stream, as it has no frame of this scene. */
int reference_stream_lacks(const struct reference_stream *reference, const char *scene,
                           struct diag *diag);

/* True if two times of one frame agree but for how they were written, to a microsecond. */
bool reference_stream_same_time(double a_s, double b_s);
