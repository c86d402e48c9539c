/* Draws in order from one address: what one random object or case is made of. The address says
 * where they belong, so that what is drawn here changes nothing elsewhere. */
#ifndef RANDOM_SEQUENCE_H
#define RANDOM_SEQUENCE_H

#include <stdbool.h>

#include "base/random.h"

struct random_sequence {
    struct random_address address;
    enum random_purpose purpose;
    uint32_t taken; /* numbers so far, four to a block */
    double block[4];
};

struct random_sequence random_sequence_at(struct random_address address,
                                          enum random_purpose purpose);

/* In (0, 1). */
double random_sequence_next(struct random_sequence *draws);

double random_sequence_between(struct random_sequence *draws, double low, double high);

/* A whole number from least to most. */
int64_t random_sequence_whole(struct random_sequence *draws, int64_t least, int64_t most);

bool random_sequence_chance(struct random_sequence *draws, double probability);

/* -1 or 1. */
double random_sequence_sign(struct random_sequence *draws);

/* A distance from a border that decisions turn on: 0 once in eight, else of either sign and evenly
 * spread in the logarithm over the six decades up to largest. */
double random_sequence_margin(struct random_sequence *draws, double largest);

#endif
