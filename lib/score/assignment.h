/* Exact least-cost pairing of a matrix's rows with its columns. */
#pragma once

#include "base/arena.h"

#define ASSIGNMENT_NONE ((size_t)-1)

/* Pairs as many rows with columns as the shorter side has, so that the sum of their costs is least:
 * shortest augmenting paths with dual prices (Jonker and Volgenant, Computing 38, 1987), one row
 * after the other. cost[row * columns + column] is finite, of any sign. Writes the column of every
 * row, or ASSIGNMENT_NONE. Equal costs are decided by the order of rows and columns alone. Takes at
 * most short^2 long steps, of the shorter and the longer side. */
void assignment_least(const double *cost, size_t rows, size_t columns, size_t *column_of,
                      struct arena *arena);
