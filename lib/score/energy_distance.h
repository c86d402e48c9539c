/* Energy distance of two random lists, from samples of both (MODEL 11.2). */
#pragma once

#include <stddef.h>

/* The distances of all lists from each other: ones lists of the first law, then others lists of the
 * second. distance[i * (ones + others) + j] is symmetric, 0 on the diagonal. D is linear in the
 * distances: a mean of matrices over frames with the same seeds gives the mean of D. */
struct energy_sample {
    const double *distance;
    size_t ones, others; /* each at least 2 */
};

double energy_distance_of(const struct energy_sample *sample);

/* The same without the list of that number, for jackknives; its law needs at least 3 lists. */
double energy_distance_without(const struct energy_sample *sample, size_t list);

/* The variance of that estimate by the jackknife over the lists of both laws; each law needs at
 * least 3 lists. */
double energy_distance_variance(const struct energy_sample *sample);
