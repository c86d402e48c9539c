/* Groups of echoes that share a resolution cell (MODEL 6).
 *
 * A cell's range and range rate are amplitude-weighted means, equations (4) and (5). Whether two
 * echoes share a cell is decided by the size of the wider echo's cell; between coherent echoes by
 * the peaks of their sum. */
#pragma once

#include <stdbool.h>

#include "base/arena.h"

/* What the stated size of a cell means. */
enum cell_extent { CELL_WIDTH, CELL_HALF_WIDTH };

struct resolution {
    double half_range_m, half_range_rate_mps; /* half the width of a cell */
    bool coherent; /* the phases of echoes are known, and the cell is what a window resolves */
};

struct resolution_echo {
    double range_m;
    double range_rate_mps;
    double amplitude; /* > 0 */
    double widening;  /* >= 0: the echo's cell is 1 + widening times as large as the sensor's */
    double phase_rad; /* of coherent echoes */
};

/* The part of an echo's amplitude at its leader's place: the response of a pulse whose resolution
 * is half a cell; 1 for the leader itself. */
double resolution_response(const struct resolution_echo *leader, const struct resolution_echo *echo,
                           const struct resolution *resolution);

/* Writes to cell[i] the number of echo i's cell and returns how many cells there are. Cells are
 * numbered from 0 in the order in which they are opened. Echoes must come strongest first, and
 * equal ones in the frame's total order, so that the result does not depend on how they were
 * listed; the first echo of a cell is its leader. */
size_t resolution_cluster(const struct resolution_echo *echoes, size_t count,
                          const struct resolution *resolution, size_t *cell, struct arena *arena);

/* True if any echo would share the cell of any other. Echoes may come in any order. */
bool resolution_close(const struct resolution_echo *echoes, size_t count,
                      const struct resolution *resolution, struct arena *arena);

/* Echoes sorted by range or by range rate, along the axis on which they spread over more cells, so
 * that few of them are within reach of each other. */
struct resolution_place {
    double place;
    size_t echo;
};
struct resolution_row {
    struct resolution_place *items;
    size_t *rank; /* rank[i] is the position of echo i in items */
    size_t count;
    double reach; /* half the largest cell: echoes farther apart share no cell */
};
struct resolution_row resolution_row_of(const struct resolution_echo *echoes, size_t count,
                                        const struct resolution *resolution, struct arena *arena);

/* The mean of count values under positive weights, as v0 + sum of w (v - v0) / sum of w with the
 * first value v0. The mean of equal values is exactly that value, and no mean leaves the interval
 * of its values (hard cases 15, 16). Weights may be from 1e-300 to 1e300 if the first is the
 * largest (hard case 17). */
double resolution_mean(const double *values, const double *weights, size_t count);
