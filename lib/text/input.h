/* Bytes and lines from a file or standard input, plain or gzip, told apart by their first bytes.
 *
 * gzip is unpacked by our own inflate loop that insists on the end mark of every member: zlib's
 * gzread has been measured to accept truncated files silently. Anything after the last member is
 * refused. A directory, a missing file and the like are DIAG_NO_INPUT, damaged gzip is DIAG_DATA.
 */
#ifndef INPUT_H
#define INPUT_H

#include <stdbool.h>
#include <stddef.h>

#include "base/diag.h"
#include "base/text.h"

struct input;

/* Takes the places of closed standard streams, so that no file that is opened later is mistaken for
 * one of them: measurement or writing there then fails. Once, in main. */
void input_guard_descriptors(void);

/* Opens a path, or standard input for "-". NULL after a message. Messages do not name the file. */
struct input *input_open(const char *path, struct diag *diag);
void input_close(struct input *input);

/* "stdin" or the path, for messages. */
const char *input_name(const struct input *input);

/* Up to size bytes; 0 at the end, -1 after a message. */
long input_read(struct input *input, char *bytes, size_t size, struct diag *diag);

/* The next line without its newline, valid until the next call: 1, 0 at the end, -1 after a
 * message (a line longer than limit bytes, or damaged input). A last line may lack its newline. */
int input_line(struct input *input, size_t limit, const char **line, size_t *length,
               struct diag *diag);

/* Everything that is left, appended to text; refuses more than limit bytes. */
int input_all(struct input *input, size_t limit, struct text *text, struct diag *diag);

#endif
