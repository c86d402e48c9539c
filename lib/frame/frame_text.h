/* A frame as a line of JSON, and back, both directed by the frame's field tables.
 *
 * The writer makes no tree and no white space; keys come in table order. The reader takes any key
 * order and any spelling of a number, refuses unknown, missing and repeated keys and anything out
 * of bounds, and names the path: "echoes[3].range_m: -1 is outside [0, 1e+06] m". */
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

/* The same for what is no frame: one line of any record. The struct must have been cleared; all it
 * holds lies in the arena. */
int frame_text_read_record(const char *line, size_t length, const struct record *record, void *base,
                           struct arena *arena, struct diag *diag);
void frame_text_write_record(const struct record *record, const void *base, struct text *text);

#endif
