/* Distance of two target lists as sums of Gaussian kernels. The lists may have any lengths.
 *
 * A list X becomes the function m(X), the sum of Gaussian kernels at its targets; the distance of
 * two lists is the length of m(X) - m(Y) in the Hilbert space of the kernel
 *     k(x, y) = sum over w of exp(-|x - y|^2 / (2 w^2)),  w = 1, 3 and 10,
 * so that <m(X), m(Y)> is the sum of k over all pairs of targets. Coordinates are range, azimuth
 * and range rate in cells, and level in steps of 3 dB; differences are not wrapped. The kernel is
 * characteristic, so m tells all lists apart (Sriperumbudur et al., JMLR 11, 2010), and the length
 * is of strong negative type (Lyons, Annals of Probability 41, 2013), as the energy distance needs
 * it. */
#pragma once

#include "base/arena.h"

enum { LIST_EMBEDDING_AXES = 4 };

/* A target: range, azimuth and range rate in cells, level in steps of 3 dB. */
struct embedded_target {
    double axis[LIST_EMBEDDING_AXES];
};

struct embedded_list {
    LIST_OF(struct embedded_target) targets;
    double square; /* <m(X), m(X)>, by list_embedding_close */
};

/* Sorts the targets, so that their order in the list changes no bit, and computes the square. */
void list_embedding_close(struct embedded_list *list, struct arena *arena);

/* |m(X) - m(Y)| >= 0 of two closed lists; sqrt(3) between a list and the same with one target more.
 */
double list_embedding_distance(const struct embedded_list *one, const struct embedded_list *other);

/* Adds a share of the distances of count closed lists from each other to a matrix as
 * energy_distance.h has it. */
void list_embedding_add_distances(const struct embedded_list *const *lists, size_t count,
                                  double share, double *distance);
