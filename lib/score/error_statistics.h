/* Bias, RMS, quantile and Wasserstein distance of errors. */
#pragma once

#include "base/arena.h"

struct error_statistics {
    double mean;     /* signed: the bias */
    double rms;      /* root mean square */
    double p95, max; /* of the errors' sizes; p95 is the least that 95 % of them do not exceed */
};

/* The statistics of count > 0 differences, in any order. Overwrites the differences. */
struct error_statistics error_statistics_of(double *differences, size_t count, struct arena *arena);

/* The Wasserstein-1 distance of two samples that are not paired: the area between their cumulative
 * distributions, which is how far the values of one must move on average to become those of the
 * other. Counts > 0; both samples are sorted on the way. A sample and the same shifted by s are |s|
 * apart. */
double error_statistics_wasserstein(double *one, size_t one_count, double *other,
                                    size_t other_count, struct arena *arena);
