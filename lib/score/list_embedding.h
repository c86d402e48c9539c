/* Distance of two target lists as sums of Gaussian kernels. The lists may have any lengths.
 *
 * It is |m(X) - m(Y)| of MODEL 11.2. The kernel is characteristic, so m tells all lists apart
 * (Sriperumbudur et al., JMLR 11, 2010), and the length is of strong negative type (Lyons, Annals
 * of Probability 41, 2013), as the energy distance needs it. Coordinates are range, azimuth and
 * range rate in cells, and level in steps of 3 dB; differences are not wrapped. */
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
