/* A progress bar on stderr. It is shown only if the source knows how many frames it will make,
 * stderr is a terminal, and standard output is none. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

struct progress {
    bool shown;
    int64_t done, expected;
    int percent;
};

void progress_begin(struct progress *progress, int64_t expected);
void progress_step(struct progress *progress);
void progress_end(struct progress *progress);

#endif
