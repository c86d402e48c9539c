/* The clock of programs that measure speed. */
#pragma once

#include <time.h>

/* CPU time of this thread. */
static inline double cpu_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e9 * (double)now.tv_sec + (double)now.tv_nsec;
}
