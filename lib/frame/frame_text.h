/* Fields of frames: in JSON, read and written (record_write.h); as columns. */
#pragma once

#include "base/text.h"
#include "frame/frame.h"

/* The longest line of a frame, in bytes. */
enum { FRAME_TEXT_SIZE = 16 * 1024 * 1024 };

/* Clears the frame and reads a line, without its newline, into it. The frame keeps no pointer into
 * the line. */
int frame_text_read(const char *line, size_t length, struct frame *frame, struct diag *diag);

/* The same, but the frame keeps the text of each member: what no stage alters is written word for
 * word. The line must stay as it is until then. The parts in `unread` are not parsed where the end
 * of their list can be told without (json_scan_skip_flat); frame->line.unread tells which. */
int frame_text_take(const char *line, size_t length, unsigned unread, struct frame *frame,
                    struct diag *diag);

/* Reads those of these parts that were left unread. */
int frame_text_read_left(struct frame *frame, unsigned parts, struct diag *diag);

/* Appends the frame's line, with its newline, to text. The frame must have passed
 * record_write_check. Fails if the line is longer than FRAME_TEXT_SIZE. */
int frame_text_write(const struct frame *frame, struct text *text, struct diag *diag);
