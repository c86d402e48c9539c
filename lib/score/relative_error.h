/* A chain's error relative to ideal echoes, and its interval.
 *
 * The lists of a reference, of a chain and of ideal echoes are samples of random lists, over the
 * same scans. The error is D of the chain over D of ideal echoes (MODEL 11.2), D being the energy
 * distance from the reference: 1 for ideal echoes, 0 for a chain with the law of the reference. The
 * interval covers 95 %.
 *
 * Scans that follow each other are alike, so they are counted in blocks: whole scenes, or stretches
 * of one. The bootstrap resamples numerator and denominator together (Hesterberg, The American
 * Statistician 69, 2015, has the factor), and a jackknife adds the scatter over seeds. Both parts
 * contain the scatter of single draws, so the interval is too wide where nothing else scatters. */
#pragma once

#include "base/arena.h"

/* The distances of all lists from each other, by block: matrices as energy_distance.h has them,
 * first the lists of the reference and then those of a chain, each a mean over the scans of its
 * block. weight is the share of each block in the mean; the weights sum to 1. */
struct energy_blocks {
    const double *distance, *weight;
    size_t blocks, references, seeds; /* at least 3 references and 3 seeds */
};

/* A figure with its 95 % interval. */
struct relative_error {
    double value, low, high;
};

/* The error of the chain, for an ideal with the same blocks and seeds; without an ideal, which is
 * NULL, D of the chain itself. There is an error only where the low end of the ideal's own D is
 * above 0. */
struct relative_error relative_error_of(const struct energy_blocks *chain,
                                        const struct energy_blocks *ideal, struct arena *arena);

/* How much more error the chain has than another one. */
struct relative_error relative_error_added(const struct energy_blocks *chain,
                                           const struct energy_blocks *other,
                                           const struct energy_blocks *ideal, struct arena *arena);
