/* Which format a file has, and what reads it.
 *
 * A reader that has refused a file asks here whether it is of another format, and then names that
 * format and the program that reads it. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "base/diag.h"

/* The rows of file_format.def. The kind of what glint reads as JSON is the name of its record; that
 * of another format is a word that its reader knows, or NULL if there is no reader. */
struct file_format {
    const char *kind, *name;
    const char *use;    /* a clause: what reads it, or what to do with it */
    const char *begins; /* text: after white space, a byte order mark and the length of a message */
    const char *has[2]; /* words among the first bytes, or NULL */
};

/* The format of a file with these first bytes, of which 4096 are enough; NULL if none is known. */
const struct file_format *file_format_of(const char *bytes, size_t length);

/* After a reader of this kind has refused the bytes (DIAG_USAGE, DIAG_DATA or DIAG_CONFIG): where
 * they are of another kind, the message becomes "NAME; USE". True if it does. */
bool file_format_explain(const char *kind, const char *bytes, size_t length, struct diag *diag);
