/* Bytes to a file or standard output.
 *
 * A named file is written under a temporary name beside it and takes its own name only when it is
 * whole and on the disk, so that a killed run leaves no partial file under a final name. A name
 * ending in .gz compresses, reproducibly. What is not a regular file (a pipe, a device) is written
 * directly. Every write and the final close are checked. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include <stddef.h>

#include "base/diag.h"
#include "base/text.h"

struct output;

/* "-" is standard output. NULL after a message (DIAG_CANNOT_CREATE). */
struct output *output_open(const char *path, struct diag *diag);

/* The text that is written next: append to it, and send what is whole of it. */
struct text *output_text(struct output *output);
int output_send(struct output *output, struct diag *diag);

/* The same of bytes that lie elsewhere. */
int output_write(struct output *output, const char *bytes, size_t length, struct diag *diag);

/* Flushes, closes and names the file; the output is gone afterwards. A run that failed keeps what
 * it wrote only on standard output: pass whole = 0 and a file is removed instead. */
int output_close(struct output *output, int whole, struct diag *diag);

#endif
