/* A pipeline read from the text of a bash script. It may have words, quotes, comments, continued
 * lines, `|`, the line `set -o pipefail`, and a here-document for its first command (<<'WORD',
 * which ends at the line WORD or with the text). Anything else (variables, redirections, file name
 * patterns, a second pipeline) is refused with its line and the advice to use bash: a script must
 * not do here what it would not do there. */
#pragma once

#include "base/arena.h"
#include "base/diag.h"

struct command {
    LIST_OF(const char *) words; /* the first is the program */
    size_t line;
};

struct pipeline {
    LIST_OF(struct command) commands;
    const char *input; /* the here-document, in the text that was read; NULL: none */
    size_t input_length;
};

/* Messages are "LINE: ...", with DIAG_USAGE. A text without a command is refused. */
int pipeline_parse(const char *text, size_t length, struct pipeline *pipeline, struct arena *arena,
                   struct diag *diag);
