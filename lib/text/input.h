/* Bytes and lines from a file, plain or packed (packing.h). The first bytes tell which.
 *
 * A directory, a missing file and the like are DIAG_NO_INPUT, damaged packed bytes are DIAG_DATA.
 *
 * A line is given out as soon as its newline can be read, from pipes, sockets and terminals and out
 * of packed files alike. */
#pragma once

#include "base/diag.h"
#include "base/text.h"

struct input;

/* Called before a wait for bytes: their writer may itself wait for output that is still held. */
struct input_pause {
    void (*act)(void *with); /* NULL: nothing */
    void *with;
};

/* Opens the standard streams that are closed, so that no file opened later gets their numbers.
 * Reading from them or writing to them then fails. Called once, in main. */
void input_guard_descriptors(void);

/* Opens a path, or standard input for "-". NULL after a message, which does not name the file. */
struct input *input_open(const char *path, struct diag *diag);
void input_close(struct input *input);

/* Sets the function that is called before a read has to wait. */
void input_before_waiting(struct input *input, struct input_pause pause);

/* "stdin" or the path, for messages. */
const char *input_name(const struct input *input);

/* The part of a regular file that has been read, from 0 to 1; 0 for any other file. */
double input_share(const struct input *input);

/* The first bytes that were read, unpacked, at most 4096, for file_format.h. */
const char *input_head(const struct input *input, size_t *length);

/* Reads up to size bytes; returns their number, 0 at the end, -1 after a message. */
long input_read(struct input *input, char *bytes, size_t size, struct diag *diag);

/* Reads the next line, without its newline; it is valid until the next call. Returns 1, 0 at the
 * end, -1 after a message (a line longer than limit bytes, or damaged input). The last line may
 * lack its newline; then a NUL follows it. */
int input_line(struct input *input, size_t limit, const char **line, size_t *length,
               struct diag *diag);

/* Appends everything that is left to text; refuses more than limit bytes. */
int input_all(struct input *input, size_t limit, struct text *text, struct diag *diag);
