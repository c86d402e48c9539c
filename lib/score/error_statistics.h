/* What many differences, or two samples, look like together. */
#ifndef ERROR_STATISTICS_H
#define ERROR_STATISTICS_H

#include "base/arena.h"

struct error_statistics {
    double mean;     /* signed: the bias */
    double rms;      /* root mean square */
    double p95, max; /* of the sizes; p95 is the least that 95 % of them do not exceed */
};

/* Of count > 0 differences, in any order, which are used up. */
struct error_statistics error_statistics_of(double *differences, size_t count, struct arena *arena);

/* The Wasserstein-1 distance of two samples that were not paired: the area between their cumulative
 * distributions, which is how far their values must move on average to become the others. Counts
 * > 0; both are sorted on the way. A sample that is shifted by s is at |s|. */
double error_statistics_wasserstein(double *one, size_t one_count, double *other,
                                    size_t other_count, struct arena *arena);

#endif
