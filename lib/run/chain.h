/* Runs one stage between pipes, or several in one process. A tool stands alone or at the end, and
 * takes its frames from the stages before it.
 *
 * Both are the same loop over the same runners, so both give the same bytes and the same exit code:
 * like a shell with pipefail, a chain ends with the code of its rightmost failing stage, and the
 * frames before the failure have gone out. */
#pragma once

#include "run/runner.h"

/* Runs prepared runners from the first frame to the last and prints the messages of those that
 * fail to stderr. Returns the exit code. */
int chain_run(struct runner *runners, size_t count);

/* The main of glint-NAME. */
int chain_main(const struct stage *stage, int count, char **words);
