/* Running stages: one alone between two pipes, or several fused in one process.
 *
 * Both are the same loop over the same runners, so both give the same bytes and the same exit code:
 * like a shell with pipefail, a chain ends with the code of its rightmost failing stage, and the
 * frames before the failure have gone out. */
#ifndef CHAIN_H
#define CHAIN_H

#include "runner.h"

/* Runs prepared runners from the first frame to the last and prints the messages of those that
 * fail to stderr. Returns the exit code. */
int chain_run(struct runner *runners, size_t count);

/* The whole of main for one stage. */
int chain_main(const struct stage *stage, int count, char **words);

/* "glint-NAME: MESSAGE" to stderr. */
void chain_complain(const struct runner *runner);

#endif
