/* A chain's error relative to ideal echoes, and its interval.
 *
 * The lists of a reference, of a chain and of ideal echoes are samples of random lists, over the
 * same scans. D is the energy distance from the reference, and the squared error is D of the chain
 * over D of ideal echoes (MODEL 11.2): 1 for ideal echoes, 0 for a chain with the law of the
 * reference. Reports print its root; contributions of effects are differences of squares.
 *
 * The interval covers 95 %: Student's t times the standard error of the jackknife over the seeds of
 * both laws, with the degrees of freedom of Welch and Satterthwaite. It holds for the same frames
 * under other seeds, not for other frames. */
#pragma once

#include "base/arena.h"
#include "score/energy_distance.h"

/* A figure with its 95 % interval and its standard error. */
struct relative_error {
    double value, low, high, deviation;
};

/* The squared error of the chain, with ideal echoes compared with the same reference; D of the
 * chain if ideal is NULL. D is unbiased, so it may be negative. Every law has at least 3 lists. The
 * caller makes sure that the interval of the ideal's D lies above 0. */
struct relative_error relative_error_of(const struct energy_sample *chain,
                                        const struct energy_sample *ideal);

/* The squared error of the chain less that of another chain, both from the same reference. */
struct relative_error relative_error_added(const struct energy_sample *chain,
                                           const struct energy_sample *other,
                                           const struct energy_sample *ideal, struct arena *arena);

/* The root of a squared error, end by end; negative ends give 0. If the value is negative, high is
 * the root of the distance from the value to the upper end. */
struct relative_error relative_error_root(struct relative_error square);

/* The 97.5 % quantile of Student's distribution with freedom > 0, by its expansion in 1/freedom
 * (Abramowitz and Stegun 26.7.5); off by 7 % for freedom 2, by less than 1 % from 4 on. */
double relative_error_student(double freedom);
