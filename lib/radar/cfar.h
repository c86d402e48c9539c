/* How far a cell must stand out from its neighbours to be no false alarm (EFFECTS 9).
 *
 * Two windows of cells, one to each side behind guard cells, tell the noise: by their mean
 * (CFAR_MEAN), or by the rank-th smallest of them (CFAR_ORDERED), which stronger echoes in the
 * window do not raise. Noise whose power is exponential and independent from cell to cell passes
 * with the probability false_alarm. */
#ifndef CFAR_H
#define CFAR_H

#include <stddef.h>

enum cfar_kind { CFAR_ORDERED, CFAR_MEAN };

enum { CFAR_MOST_CELLS = 64 };

struct cfar {
    enum cfar_kind kind;
    size_t cells; /* of both windows together, even, at most CFAR_MOST_CELLS */
    size_t guard; /* cells left out on each side */
    size_t rank;  /* from 1 for the smallest */
    double factor;
};

/* alpha = N (P^(-1/N) - 1) for the mean; for the rank k the T that solves
 * P = prod over i < k of (N - i)/(N - i + T). */
double cfar_factor(enum cfar_kind kind, size_t cells, size_t rank, double false_alarm);

/* The power that the cell `at` must reach, in a ring of count cells that lie stride apart: count at
 * least cells + 2 guard + 1. */
double cfar_threshold(const struct cfar *cfar, const double *power, size_t count, size_t stride,
                      size_t at);

#endif
