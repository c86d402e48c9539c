/* Energy distance of two random target lists, from their samples (MODEL 11.2).
 *
 * The distance of two lists, of any lengths, is |m(X) - m(Y)|, m being a sum of Gaussian kernels.
 * The kernel is characteristic, so m tells all lists apart (Sriperumbudur et al., JMLR 11, 2010),
 * and the length is of strong negative type (Lyons, Annals of Probability 41, 2013), as the energy
 * distance needs it. Differences of coordinates are not wrapped. */
#pragma once

#include <stdbool.h>

#include "base/arena.h"

enum { EMBEDDED_AXES = 4 };

/* A target: range, azimuth and range rate in cells, level in steps of 3 dB. */
struct embedded_target {
    double axis[EMBEDDED_AXES];
};

struct embedded_list {
    LIST_OF(struct embedded_target) targets;
    double square; /* <m(X), m(X)>, by energy_distance_close */
};

/* Sorts the targets, so that their order in the list changes no bit, and computes the square. */
void energy_distance_close(struct embedded_list *list, struct arena *arena);

/* Have two closed lists the same targets? */
bool energy_distance_equal(const struct embedded_list *one, const struct embedded_list *other);

/* |m(X) - m(Y)| >= 0 of two closed lists; sqrt(3) between a list and the same with one target more.
 */
double energy_distance_of_lists(const struct embedded_list *one, const struct embedded_list *other);

/* The distances of all lists from each other: ones lists of the first law, then others lists of the
 * second. distance[i * (ones + others) + j] is symmetric, 0 on the diagonal. D is linear in the
 * distances: a mean of matrices over frames with the same seeds gives the mean of D. */
struct energy_sample {
    const double *distance;
    size_t ones, others; /* each at least 2 */
};

/* Adds the distances between count closed lists, times share, to such a matrix. */
void energy_distance_add(const struct embedded_list *const *lists, size_t count, double share,
                         double *distance);

double energy_distance_of(const struct energy_sample *sample);

/* The energy distance without one list, for jackknives; the law of the list needs at least 3. */
double energy_distance_without(const struct energy_sample *sample, size_t list);
