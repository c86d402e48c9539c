#include "score/relative_error.h"

#include <assert.h>

#include "base/elementary.h"

double relative_error_student(double freedom)
{
    assert(freedom > 0);
    double z = 1.959964, square = z * z;
    double first = (square + 1) / 4;
    double second = ((5 * square + 16) * square + 3) / 96;
    double third = (((3 * square + 19) * square + 17) * square - 15) / 384;
    return z * (1 + ((third / freedom + second) / freedom + first) / freedom);
}

/* The variance of chain over ideal by the jackknife over count lists of one law; that of chain if
 * ideal is NULL. */
static double jackknife(const struct energy_sample *chain, const struct energy_sample *ideal,
                        size_t first, size_t count)
{
    double n = (double)count;
    double mean = 0, squares = 0;
    for (size_t i = first; i < first + count; i++) {
        double below = ideal != NULL ? energy_distance_without(ideal, i) : 1;
        double ratio = energy_distance_without(chain, i) / below, apart = ratio - mean;
        mean += apart / (double)(i - first + 1);
        squares += apart * (ratio - mean);
    }
    return (n - 1) / n * squares;
}

struct relative_error relative_error_of(const struct energy_sample *chain,
                                        const struct energy_sample *ideal)
{
    assert(chain->ones >= 3 && chain->others >= 3);
    assert(ideal == NULL || (ideal->ones == chain->ones && ideal->others == chain->others));
    double value = energy_distance_of(chain) / (ideal != NULL ? energy_distance_of(ideal) : 1);
    double one = jackknife(chain, ideal, 0, chain->ones);
    double other = jackknife(chain, ideal, chain->ones, chain->others);
    double variance = one + other;
    if (!(variance > 0))
        return (struct relative_error){value, value, value, 0};
    double freedom =
        variance * variance /
        (one * one / (double)(chain->ones - 1) + other * other / (double)(chain->others - 1));
    double half = relative_error_student(freedom) * sqrt(variance);
    return (struct relative_error){value, value - half, value + half, sqrt(variance)};
}

/* The energy distance is linear in the matrix of distances, so the difference of two energy
 * distances is that of the difference of their matrices. */
struct relative_error relative_error_added(const struct energy_sample *chain,
                                           const struct energy_sample *other,
                                           const struct energy_sample *ideal, struct arena *arena)
{
    assert(chain->ones == other->ones && chain->others == other->others);
    size_t all = chain->ones + chain->others;
    double *difference = arena_get(arena, all * all * sizeof *difference);
    for (size_t i = 0; i < all * all; i++)
        difference[i] = chain->distance[i] - other->distance[i];
    return relative_error_of(&(struct energy_sample){difference, chain->ones, chain->others},
                             ideal);
}

struct relative_error relative_error_root(struct relative_error square)
{
    double above = elementary_max(square.value, 0);
    return (struct relative_error){
        .value = sqrt(above),
        .low = sqrt(elementary_max(square.low, 0)),
        .high = sqrt(above + square.high - square.value),
    };
}
