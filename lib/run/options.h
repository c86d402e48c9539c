/* Command line and --help of a program, from tables. One table has its own options, the other those
 * that all programs share. */
#pragma once

#include "base/arena.h"
#include "base/diag.h"
#include "base/text.h"

#define GLINT_VERSION "1.0.0"

struct stage;

/* The options that programs share; each understands those that mean something for it. */
struct common_options {
    const char *output;   /* NULL: standard output */
    const char *sections; /* NULL: what the frames say */
    bool complete;
    uint64_t seed;
    bool seed_given;
    bool help, version;
    LIST_OF(const char *) files; /* of frames; none: standard input */
};

/* Reads the words after the program's name into state and common, both cleared first, in GNU style:
 * --radius-m 50, --radius-m=50, -o FILE, -h; -- ends the options; a flag takes no value; the last
 * of two counts. Refuses unknown options, missing values and values out of bounds with DIAG_USAGE.
 * Required options may be missing beside --help and --version. */
int options_read(const struct stage *stage, size_t count, const char *const *words, void *state,
                 struct common_options *common, struct arena *arena, struct diag *diag);

/* The text of --help, in the form from which help2man makes a manual page. */
void options_help(const struct stage *stage, struct text *text);
