/* Output to a file, plain or packed, whole or nothing.
 *
 * A named file is written without a name, in the folder where it will be, and takes its name only
 * when it is complete and on the disk: a run that fails or is killed leaves the old file or none.
 * It replaces the file that is there, and has its mode and, where the user may give it away, its
 * owner and its group; other names of the old file (hard links) keep the old bytes. A file that may
 * be written but not replaced is refused: the shell can write into it. A name ending in .gz
 * or .zst compresses (packing.h).
 *
 * Links are followed, also one to a file that is not there, and never replaced. What is not a
 * regular file (a pipe, a device) is written directly, and so is a descriptor that is open:
 * standard output, /dev/fd/N, /proc/self/fd/N. Every write and the final close are checked. */
#pragma once

#include "base/diag.h"
#include "base/text.h"

struct output;

/* Opens a path for writing; "-" and /dev/stdout are standard output. NULL after a message
 * (DIAG_CANNOT_CREATE; DIAG_IO for a descriptor that is not open for writing). */
struct output *output_open(const char *path, struct diag *diag);

/* The text to append to, and a call that writes its whole pieces of 64 KiB. */
struct text *output_text(struct output *output);
int output_send(struct output *output, struct diag *diag);

/* True if text is held and a terminal will show it. */
bool output_prints(const struct output *output);

/* Writes all that is held to standard output, a pipe or a device, where a reader may wait for it.
 * Files and compressed output hold it until there is more, or the end. */
int output_flush(struct output *output, struct diag *diag);

/* Appends bytes, and writes whole pieces. */
int output_write(struct output *output, const char *bytes, size_t length, struct diag *diag);

/* Writes all that is held, then these bytes over the first of the file, which must be plain. */
int output_write_head(struct output *output, const char *bytes, size_t length, struct diag *diag);

/* Writes all that is held, to the disk if it is a file, so that closing only gives it its name. */
int output_finish(struct output *output, struct diag *diag);

/* Finishes, closes and names the file; the output is gone afterwards. If whole is false, a file is
 * removed instead; what was written to standard output or to a device stays written. */
int output_close(struct output *output, bool whole, struct diag *diag);

/* The same for outputs that belong together, as tables do: none has its name before all are on the
 * disk, and the old files of these names go aside before the first new one comes. If one cannot
 * have its name, all old ones come back. A program that is killed meanwhile leaves some old files
 * or some new ones, or none, but no old one beside a new one; the next one that writes there
 * removes those that are aside. */
int output_close_all(struct output **outputs, size_t count, bool whole, struct diag *diag);

/* Writes bytes to an open file: 0, or -1 with errno. Waits where there is no room, also if the
 * file was opened non-blocking. */
int output_write_all(int fd, const char *bytes, size_t length);

/* Writes bytes to standard output and closes it. */
int output_print(const char *bytes, size_t length, struct diag *diag);
