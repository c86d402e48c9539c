/* Sequence of random draws from one address. One random object or case takes all its draws from one
 * sequence; its address keeps them independent of all other draws. */
#pragma once

#include <stdbool.h>

#include "base/random.h"

struct random_sequence {
    struct random_address address;
    enum random_purpose purpose;
    uint32_t taken; /* draws so far, four to a block */
    double block[4];
};

struct random_sequence random_sequence_at(struct random_address address,
                                          enum random_purpose purpose);

/* The next draw, uniform in (0, 1). */
double random_sequence_next(struct random_sequence *sequence);

double random_sequence_between(struct random_sequence *sequence, double low, double high);

/* A whole number from least to most, both included. */
int64_t random_sequence_whole(struct random_sequence *sequence, int64_t least, int64_t most);

bool random_sequence_chance(struct random_sequence *sequence, double probability);

/* -1 or 1. */
double random_sequence_sign(struct random_sequence *sequence);
