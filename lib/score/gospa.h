/* How far a list is from the truth, as one number: GOSPA and OSPA of order 2.
 *
 * GOSPA (Rahmathullah, Garcia-Fernandez, Svensson 2017) with alpha = 2 is the least, over all ways
 * to pair true items with listed ones, of
 *     sqrt(sum over pairs of d^2 + c^2/2 for every true item left + c^2/2 for every listed one),
 * so it tells what is misplaced from what is missed and what is false. It is not divided by the
 * number of items. OSPA (Schuhmacher, Vo, Vo 2008) is
 *     sqrt((sum over pairs of d^2 + c^2 for each of the longer list without a pair) / longer),
 * an average that never exceeds c. Both are metrics if d is, and the same pairs serve both: none is
 * as far apart as the cut-off c. */
#ifndef GOSPA_H
#define GOSPA_H

#include "base/arena.h"

struct gospa {
    double value;                                 /* the square root of the sum of: */
    double localisation, missed_part, false_part; /* squares of d */
};

/* The pairs. distance[truth * listed + item] is d >= 0; NaN never. Writes the listed item of every
 * true one, or ASSIGNMENT_NONE, and returns how many pairs there are. */
size_t gospa_pair(const double *distance, size_t truths, size_t listed, double cutoff,
                  size_t *item_of, struct arena *arena);

/* From the pairs' sum of d^2 and their number. Of two empty lists both are 0. */
struct gospa gospa_of(double squares, size_t pairs, size_t truths, size_t listed, double cutoff);
double gospa_ospa(double squares, size_t pairs, size_t truths, size_t listed, double cutoff);

#endif
