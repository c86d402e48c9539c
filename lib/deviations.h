/* What many differences, or two samples, look like together. */
#ifndef DEVIATIONS_H
#define DEVIATIONS_H

#include "memory.h"

struct deviations {
    double mean;     /* signed: the bias */
    double rms;      /* root mean square */
    double p95, max; /* of the sizes; p95 is the least that 95 % of them do not exceed */
};

/* Of count > 0 differences, in any order. */
struct deviations deviations_of(const double *differences, size_t count, struct arena *arena);

/* The Wasserstein-1 distance of two samples that were not paired: the area between their cumulative
 * distributions, which is how far their values must move on average to become the others. Counts
 * > 0, in any order. A sample that is shifted by s is at |s|. */
double deviations_wasserstein(const double *one, size_t one_count, const double *other,
                              size_t other_count, struct arena *arena);

#endif
