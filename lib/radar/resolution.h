/* Which echoes the radar cannot tell apart (MODEL 6, equations 4 and 5).
 *
 * The strongest echo left opens a cell centred on it and takes every echo left within half a cell
 * in range and in range rate, borders included as the doubles decide; then the next strongest.
 * A cell's range and rate are amplitude-weighted means. */
#ifndef RESOLUTION_H
#define RESOLUTION_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"

struct resolution_echo {
    double range_m;
    double range_rate_mps;
    double amplitude; /* > 0 */
};

/* Echoes must come strongest first (ties in the frame's total order: the answer then does not
 * depend on how the echoes were listed). Writes to cell[i] the number of echo i's cell, counted
 * from 0 in the order they were opened, and returns how many cells there are. The first echo of a
 * cell is its leader. A leader looks only at echoes of its own ranges, which are sorted once. */
size_t resolution_cluster(const struct resolution_echo *echoes, size_t count, double half_range_m,
                          double half_range_rate_mps, size_t *cell, struct arena *arena);

/* Do any two echoes lie within half a cell of each other in both, so that there is something to
 * merge? by_range has room for the echoes; they may come in any order. */
bool resolution_close(const struct resolution_echo *echoes, size_t count, double half_range_m,
                      double half_range_rate_mps, struct resolution_echo *by_range,
                      struct arena *arena);

/* The mean of count values under positive weights, anchored at the first value: values + sum of
 * w (v - v0) / sum of w. Equal values come back exactly, and the mean never leaves their span
 * (NUMERICS 15, 16). Weights are divided by the first one before they are summed, so amplitudes
 * from 1e-300 to 1e300 are fine if the first is the largest (17). */
double resolution_mean(const double *values, const double *weights, size_t count);

#endif
