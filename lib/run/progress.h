/* Rate and time left of long work, on stderr. The line appears where stderr is a terminal and the
 * work has lasted for a second, changes a few times a second, and is gone at the end:
 *
 *     [########                ]  33 %, 4100 frames/s, 0:00:12 left
 *
 * In a narrow terminal its end is cut off. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct progress {
    const char *unit; /* what is counted: "frames" */
    int64_t count;
    double begin_s, next_s; /* by a clock; next_s is INFINITY where stderr is no terminal */
    bool shown;
};

void progress_begin(struct progress *progress, const char *unit);

/* Counts one more. True if it is time to show how far the work is. */
bool progress_step(struct progress *progress);

/* Shows it; share is the part that is done. 0 shows nothing: it is not known. */
void progress_show(struct progress *progress, double share);
void progress_end(struct progress *progress);

/* The line after so long, for a share above 0; above 1 counts as 1. */
void progress_write(const struct progress *progress, double elapsed_s, double share, char *line,
                    size_t size);
