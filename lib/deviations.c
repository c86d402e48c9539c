#include "deviations.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "sort.h"

static int ascending(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

static double *sorted(const double *values, size_t count, struct arena *arena)
{
    double *copy = arena_get(arena, count * sizeof *copy);
    memcpy(copy, values, count * sizeof *copy);
    sort_items(copy, count, sizeof *copy, ascending, arena);
    return copy;
}

/* Sums run over sorted values, so that the order of the differences changes no bit. */
struct deviations deviations_of(const double *differences, size_t count, struct arena *arena)
{
    double *size = sorted(differences, count, arena);
    double sum = 0, squares = 0;
    for (size_t i = 0; i < count; i++) {
        sum += size[i];
        squares += size[i] * size[i];
        size[i] = fabs(size[i]);
    }
    sort_items(size, count, sizeof *size, ascending, arena);
    return (struct deviations){
        .mean = sum / (double)count,
        .rms = sqrt(squares / (double)count),
        .p95 = size[(19 * count + 19) / 20 - 1],
        .max = size[count - 1],
    };
}

double deviations_wasserstein(const double *one, size_t one_count, const double *other,
                              size_t other_count, struct arena *arena)
{
    const double *a = sorted(one, one_count, arena), *b = sorted(other, other_count, arena);
    double area = 0, from = fmin(a[0], b[0]);
    size_t i = 0, j = 0; /* how many of each are at most `from` */
    while (i < one_count || j < other_count) {
        bool first = j == other_count || (i < one_count && a[i] <= b[j]);
        double to = first ? a[i] : b[j];
        double apart = fabs((double)(i * other_count) - (double)(j * one_count));
        area += apart * (to - from);
        from = to;
        *(first ? &i : &j) += 1;
    }
    return area / ((double)one_count * (double)other_count);
}
