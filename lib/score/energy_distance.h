/* Energy distance of two random lists, from samples of both.
 *
 * For lists X, X' of one law and Y, Y' of another, all independent,
 *     D = 2 E d(X, Y) - E d(X, X') - E d(Y, Y'),
 * which is 0 between equal laws and, for a distance d of strong negative type, between no others
 * (Szekely and Rizzo 2013; Lyons 2013). The estimate is the U-statistic: it is unbiased, so of
 * equal laws it is as often below 0 as above. */
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
