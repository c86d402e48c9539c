/* The text of a pipeline, as far as it means to us what it means to bash: words, quotes, comments,
 * continuations, `|`, and the line `set -o pipefail`. Anything else (variables, redirections,
 * globs, a second pipeline) is refused with its line and the advice to use bash, because running it
 * differently would be worse than not running it. */
#ifndef PIPELINE_H
#define PIPELINE_H

#include "base/arena.h"
#include "base/diag.h"

struct command {
    LIST_OF(const char *) words; /* the first is the program */
    size_t line;
};

struct pipeline {
    LIST_OF(struct command) commands;
};

/* Messages are "LINE: ...", with DIAG_USAGE. A text without a command is refused. */
int pipeline_parse(const char *text, size_t length, struct pipeline *pipeline, struct arena *arena,
                   struct diag *diag);

#endif
