/* A frame as a line of JSON (record_text.h), and back. */
#ifndef FRAME_TEXT_H
#define FRAME_TEXT_H

#include "base/text.h"
#include "frame/frame.h"

enum { FRAME_TEXT_SIZE = 16 * 1024 * 1024 };

/* Reads the line (without its newline) into the frame, which is cleared first. The frame keeps
 * nothing of the line. */
int frame_text_read(const char *line, size_t length, struct frame *frame, struct diag *diag);

/* Appends the line with its newline to text. The frame must have passed field_check. Refuses a
 * line longer than FRAME_TEXT_SIZE. */
int frame_text_write(const struct frame *frame, struct text *text, struct diag *diag);

#endif
