/* Poisson and negative binomial counts from one uniform draw.
 *
 * The count is the least k with P(N <= k) >= uniform (inversion), so it grows with the uniform draw
 * and depends on nothing else. The cost grows with the square root of the mean, times the
 * overdispersion. Probabilities are good to about 1e-13; tails beyond 2^-75 of the probability at
 * the mean are left out, because no uniform draw of random.h reaches them. */
#pragma once

#include <stdint.h>

/* A Poisson count with a mean from 0 to 1e9; a larger mean counts as 1e9, one that is not positive
 * as 0. uniform in (0, 1). */
int64_t poisson_count(double mean, double uniform);

/* A negative binomial count with this mean and overdispersion times the variance of Poisson (MODEL
 * 14.9, 14.13): a Poisson count whose mean varies as a gamma variate. Overdispersion 1, and
 * anything less, is Poisson; at most 1e3. With f = overdispersion,
 *
 *     P(k + 1) / P(k) = (mean + k (f - 1)) / (f (k + 1)). */
int64_t poisson_overdispersed_count(double mean, double overdispersion, double uniform);
