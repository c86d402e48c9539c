/* Runs one stage between pipes, or several in one process. A tool stands alone or at the end, and
 * takes its frames from the stages before it.
 *
 * Both are the same loop over the same runners, so both give the same bytes and the same exit code:
 * like a shell with pipefail, a chain ends with the code of its rightmost failing stage, and the
 * frames before the failure have gone out. */
#pragma once

#include "run/runner.h"

/* Where the time of a chain went: nanoseconds of this thread's CPU time, without those that
 * reading the clock takes. */
struct chain_times {
    int64_t frames, bytes_read, bytes_written;
    int64_t clock_ns; /* of one look at the clock */
    int64_t read_ns, write_ns;
    int64_t *step_ns; /* one for each runner */
};

/* CPU time of this thread, in nanoseconds. */
int64_t chain_cpu_ns(void);

/* Runs prepared runners from the first frame to the last and prints the messages of those that
 * fail to stderr. Returns the exit code. Clocks are read only if times is not NULL. */
int chain_run(struct runner *runners, size_t count, struct chain_times *times);

/* The main of glint-NAME. */
int chain_main(const struct stage *stage, int count, char **words);
