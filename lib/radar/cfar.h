/* Detection thresholds with a constant false alarm rate (MODEL 11.4; Rohling 1983).
 *
 * The noise in a cell is estimated from two windows of cells, one to each side behind guard cells:
 * by their mean power (CFAR_MEAN) or by the rank-th smallest power (CFAR_ORDERED), which a few
 * strong echoes in the window do not raise. */
#pragma once

#include <stddef.h>

enum cfar_kind { CFAR_ORDERED, CFAR_MEAN };

enum { CFAR_MOST_CELLS = 64 };

struct cfar {
    enum cfar_kind kind;
    size_t cells;   /* in both windows together; even, at most CFAR_MOST_CELLS */
    size_t nearest; /* distance of each window's first cell from the cell under test, at least 1 */
    size_t spacing; /* from one cell of a window to the next, at least 1 */
    size_t rank;    /* for CFAR_ORDERED: 1 is the smallest, at most cells */
    double factor;  /* cfar_factor */
};

/* The factor for which noise passes with the probability P = false_alarm, if its power is
 * exponential and independent in all cells. For the mean of N cells it is N (P^(-1/N) - 1); for the
 * rank k it solves P = product over i < k of (N - i)/(N - i + factor). */
double cfar_factor(enum cfar_kind kind, size_t cells, size_t rank, double false_alarm);

/* Cells from the first of one window to the last of the other, the cell under test included. */
size_t cfar_extent(const struct cfar *cfar);

/* The power that the cell `at` must reach. The count cells form a ring, cell i is power[i *
 * stride], and count is at least cfar_extent. */
double cfar_threshold(const struct cfar *cfar, const double *power, size_t count, size_t stride,
                      size_t at);
