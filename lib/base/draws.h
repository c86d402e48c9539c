/* Draws in order from one address: what one random object or case is made of. The address says
 * where they belong, so that what is drawn here changes nothing elsewhere. */
#ifndef DRAWS_H
#define DRAWS_H

#include <stdbool.h>

#include "random.h"

struct draws {
    struct random_address address;
    enum random_purpose purpose;
    uint32_t taken; /* numbers so far, four to a block */
    double block[4];
};

struct draws draws_at(struct random_address address, enum random_purpose purpose);

/* In (0, 1). */
double draws_next(struct draws *draws);

double draws_between(struct draws *draws, double low, double high);

/* A whole number from least to most. */
int64_t draws_whole(struct draws *draws, int64_t least, int64_t most);

bool draws_chance(struct draws *draws, double probability);

/* -1 or 1. */
double draws_sign(struct draws *draws);

/* A distance from a border that decisions turn on: 0 once in eight, else of either sign and evenly
 * spread in the logarithm over the six decades up to largest. */
double draws_margin(struct draws *draws, double largest);

#endif
