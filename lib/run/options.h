/* The command line of a program, from its table of options and the table of those that all share.
 */
#ifndef OPTIONS_H
#define OPTIONS_H

#include "base/arena.h"
#include "base/diag.h"
#include "base/text.h"
#include "run/program.h"

#define GLINT_VERSION "0.1.0"

/* What every program understands, as far as it is of use there. */
struct common_options {
    const char *output; /* NULL is standard output */
    const char *explain;
    bool keep;
    bool complete;
    uint64_t seed;
    bool seed_given;
    bool help, version;
    LIST_OF(const char *) files; /* of frames; empty is standard input */
};

/* Reads the words after the program's name into state (which is cleared first) and common. GNU
 * style: --radius-m 50, --radius-m=50, -o FILE, -- ends the options. Refuses unknown options,
 * missing values and values out of bounds with DIAG_USAGE; required options may be missing only
 * next to --help and --version. */
int options_read(const struct program *program, size_t count, const char *const *words, void *state,
                 struct common_options *common, struct arena *arena, struct diag *diag);

/* What --help prints, in the form that help2man reads. */
void options_help(const struct program *program, struct text *text);

#endif
