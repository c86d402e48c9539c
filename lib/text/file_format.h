/* Formats of files, and the programs that read them.
 *
 * After a reader has refused a file, the message names the format of the file and the program that
 * reads it. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "base/diag.h"

/* The rows of file_format.def. The kind of a JSON format of glint is the name of its record; the
 * kind of another format is a word that its reader gives, or NULL if there is no reader. */
struct file_format {
    const char *kind, *name;
    const char *use;    /* a clause: what reads it, or what to do with it */
    const char *begins; /* text: after white space, a byte order mark and the length of a message */
    const char *has[2]; /* words among the first bytes, or NULL */
};

/* The format of a file that begins with these bytes; 4096 are enough. NULL if none is known. */
const struct file_format *file_format_of(const char *bytes, size_t length);

/* Called after a reader of this kind has refused the bytes (DIAG_USAGE, DIAG_DATA or DIAG_CONFIG).
 * If they are of another kind, makes the message "NAME; USE" and returns true. */
bool file_format_explain(const char *kind, const char *bytes, size_t length, struct diag *diag);
