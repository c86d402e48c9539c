/* Runs one stage between pipes, or several in one process. A tool stands alone or at the end, and
 * takes its frames from the stages before it.
 *
 * Both are the same loop over the same runners, so both give the same bytes and the same exit code:
 * like a shell with pipefail, a chain ends with the code of its rightmost failing stage, and the
 * frames before the failure have gone out. */
#pragma once

#include "run/runner.h"

/* CPU time of this thread for reading and writing frames, without the time that reading the clock
 * takes. Each runner has that of its own steps (spent_ns). */
struct chain_times {
    int64_t frames, bytes_read, bytes_written;
    int64_t clock_ns; /* of one look at the clock */
    int64_t read_ns, write_ns;
};

/* CPU time of this thread, in nanoseconds. */
int64_t chain_cpu_ns(void);

/* Runs prepared runners from the first frame to the last and prints the messages of those that
 * fail to stderr. Returns the exit code. times, if not NULL, is filled in: clocks are read only
 * then. */
int chain_run(struct runner *runners, size_t count, struct chain_times *times);

/* The main of glint-NAME. */
int chain_main(const struct stage *stage, int count, char **words);
