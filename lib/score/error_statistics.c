#include "score/error_statistics.h"

#include <stdbool.h>

#include "base/elementary.h"
#include "base/sort.h"

/* Sums over the sorted values, so that the order of the differences changes no bit. */
struct error_statistics error_statistics_of(double *differences, size_t count, struct arena *arena)
{
    double sum = 0, squares = 0, *size = differences;
    sort_numbers(differences, count, arena);
    for (size_t i = 0; i < count; i++) {
        sum += differences[i];
        squares += differences[i] * differences[i];
        size[i] = fabs(differences[i]);
    }
    sort_numbers(size, count, arena);
    return (struct error_statistics){
        .mean = sum / (double)count,
        .rms = sqrt(squares / (double)count),
        .p95 = size[(19 * count + 19) / 20 - 1],
        .max = size[count - 1],
    };
}

double error_statistics_wasserstein(double *one, size_t one_count, double *other,
                                    size_t other_count, struct arena *arena)
{
    sort_numbers(one, one_count, arena);
    sort_numbers(other, other_count, arena);
    double area = 0, from = elementary_min(one[0], other[0]);
    size_t i = 0, j = 0; /* number of values of each that are at most `from` */
    while (i < one_count || j < other_count) {
        bool first = j == other_count || (i < one_count && one[i] <= other[j]);
        double to = first ? one[i] : other[j];
        double apart = fabs((double)(i * other_count) - (double)(j * one_count));
        area += apart * (to - from);
        from = to;
        *(first ? &i : &j) += 1;
    }
    return area / ((double)one_count * (double)other_count);
}
