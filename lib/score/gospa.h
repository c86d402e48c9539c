/* GOSPA and OSPA of order 2 between two lists (MODEL 11.2).
 *
 * GOSPA with alpha = 2 separates what is misplaced from what is missed and what is false; it is not
 * divided by the number of items. OSPA is an average that never exceeds the cut-off. Both are
 * metrics if d is. The same pairs serve both: all are closer than the cut-off. */
#pragma once

#include "base/arena.h"

#define GOSPA_NONE ((size_t)-1)

struct gospa {
    double value;                                 /* square root of the sum of the three parts */
    double localisation, missed_part, false_part; /* in squares of d */
    double ospa;
};

/* Finds the pairs. distance[truth * listed + item] is d >= 0, never NaN. Writes the listed item of
 * every true one, or GOSPA_NONE, and returns the number of pairs. */
size_t gospa_pair(const double *distance, size_t truths, size_t listed, double cutoff,
                  size_t *item_of, struct arena *arena);

/* GOSPA and OSPA from the pairs' sum of d^2 and their number. Both are 0 for two empty lists. */
struct gospa gospa_of(double squares, size_t pairs, size_t truths, size_t listed, double cutoff);

/* Pairs as many rows with columns as the shorter side has, so that the sum of their costs is least:
 * shortest augmenting paths with dual prices (Jonker and Volgenant, Computing 38, 1987), one row
 * after the other. cost[row * columns + column] is finite, of any sign. Writes the column of every
 * row, or GOSPA_NONE. Equal costs are decided by the order of rows and columns alone. Takes at most
 * short^2 long steps, of the shorter and the longer side. */
void gospa_assign(const double *cost, size_t rows, size_t columns, size_t *column_of,
                  struct arena *arena);
