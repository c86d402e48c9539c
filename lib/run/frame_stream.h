/* The frames that a program reads. They are JSON lines from files, one file after the other, or
 * from standard input. */
#pragma once

#include "frame/frame_sequence.h"
#include "text/input.h"

struct frame_stream {
    const char *const *paths;
    size_t count; /* of paths; 0: standard input */
    struct input *input;
    struct input_pause pause; /* before a wait for the next frame */
    unsigned unread;          /* parts that need not be read with the frame (frame_text.h) */
    size_t path, line;        /* how many paths are open or done, and lines of the last of them */
};

/* The next frame, in canonical order and checked: 1; 0 at the end; -1 after a message. It keeps the
 * texts of its line, which stays as it is until the next call (frame_text.h). */
int frame_stream_next(struct frame_stream *stream, struct frame *frame, struct diag *diag);

/* Reads parts of the frame that were left unread, orders and checks them. */
int frame_stream_read_left(struct frame *frame, unsigned parts, struct diag *diag);

/* One line, without its newline, as such a frame: 0, or -1 after a message. */
int frame_stream_parse(const char *line, size_t length, struct frame *frame, struct diag *diag);

/* File and line of the last frame. */
struct frame_place frame_stream_place(const struct frame_stream *stream);

/* The part of all input that has been read, as if all files were of one size; 0: not known. */
double frame_stream_share(const struct frame_stream *stream);

/* Puts file and line of the last frame in front of a message. Nothing at the end of the stream. */
void frame_stream_name_line(const struct frame_stream *stream, struct diag *diag);

void frame_stream_close(struct frame_stream *stream);
