/* How many: counts drawn from one uniform number by inversion.
 *
 * The answer is the least k with P(N <= k) >= uniform, so a count grows with its uniform and
 * depends on nothing else. Cost grows with the square root of the mean, times the overdispersion.
 * Probabilities are good to about 1e-13, tails beyond 2^-75 of the mean's are left out:
 * no uniform of random.h reaches them. */
#ifndef POISSON_H
#define POISSON_H

#include <stdint.h>

/* Poisson with a mean from 0 to 1e9 (more counts as that); 0 for means that are not positive.
 * uniform in (0, 1). */
int64_t poisson_count(double mean, double uniform);

/* Negative binomial of that mean with overdispersion times the variance of Poisson (EFFECTS 9, 24):
 * a Poisson count whose mean varies as a gamma variate. Overdispersion 1, and anything less, is
 * Poisson; at most 1e3. With f = overdispersion,
 *     P(k + 1) / P(k) = (mean + k (f - 1)) / (f (k + 1)). */
int64_t poisson_overdispersed_count(double mean, double overdispersion, double uniform);

#endif
