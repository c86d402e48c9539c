/* A chain's error relative to ideal echoes, and its interval.
 *
 * The lists of a reference, of a chain and of ideal echoes are samples of random lists, over the
 * same scans. D is the energy distance from the reference, and the squared error is D of the chain
 * over D of ideal echoes (MODEL 11.2): 1 for ideal echoes, 0 for a chain with the law of the
 * reference. Its root is what people read; effects add up in the square alone.
 *
 * The interval covers 95 %: Student's t times the standard error of the jackknife over the seeds of
 * both laws, with the degrees of freedom of Welch and Satterthwaite. It is that of the same frames
 * under other seeds, and says nothing of other frames. */
#pragma once

#include "base/arena.h"
#include "score/energy_distance.h"

/* A figure with its 95 % interval and its standard error. */
struct relative_error {
    double value, low, high, deviation;
};

/* The squared error of the chain, for an ideal of the same reference; without an ideal, which is
 * NULL, D of the chain itself. Estimates are unbiased, so they may be negative. Every law has at
 * least 3 lists. There is an error only where the low end of the ideal's own D is above 0. */
struct relative_error relative_error_of(const struct energy_sample *chain,
                                        const struct energy_sample *ideal);

/* How much more squared error the chain has than another one of the same reference. */
struct relative_error relative_error_added(const struct energy_sample *chain,
                                           const struct energy_sample *other,
                                           const struct energy_sample *ideal, struct arena *arena);

/* The root of a squared error. Value and low are 0 where the square is not above 0; high then is
 * the root of the upper half of its interval. */
struct relative_error relative_error_root(struct relative_error square);

/* The 97.5 % quantile of Student's distribution with freedom > 0, by its expansion in 1/freedom
 * (Abramowitz and Stegun 26.7.5); off by 7 % for freedom 2, by less than 1 % from 4 on. */
double relative_error_student(double freedom);
