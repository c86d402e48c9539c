/* Search in sorted tables, by numbers or by a condition.
 *
 * Tables of straight pieces pass one row less than they have, and so get the row at which a piece
 * begins. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* The last of the rows whose number is at most `at`; 0 if there is none. `first` is the number of
 * the first row, and stride the bytes from row to row. The numbers ascend, with equal ones beside
 * each other; they and their differences are finite. Rows at even steps are found at once. */
size_t search_row(const double *first, size_t stride, size_t count, double at);

/* The last of the rows that are reached; low if there is none. Rows that are reached come before
 * those that are not, high among them. */
static inline size_t search_last(size_t low, size_t high,
                                 bool (*reached)(const void *of, size_t row), const void *of)
{
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (reached(of, middle))
            low = middle;
        else
            high = middle;
    }
    return low;
}
