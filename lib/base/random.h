/* Random numbers, each a function of its own address (Philox4x64, Random123).
 *
 * The address is the seed, the scene, the frame, the sensor, the reflector and the purpose. A draw
 * depends on nothing else: not on shards, the order of objects, effects that are left out, or
 * whether stages are piped or fused. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

/* The purpose of a draw: a number that is part of every data set made, so that it never changes and
 * no two purposes share one. Numbers below RANDOM_OWN are glint's: those here, and those that only
 * one effect draws for, which stand in its file (effects/effect.h).
 * tests/unit/effects/test_effect.c finds a number that is taken twice, and names the next free one.
 */
enum random_purpose {
    RANDOM_POINTERS = 1,        /* complex noise on sum and delta: four Gaussians */
    RANDOM_RANGE_RATE = 2,      /* noise on range and range rate */
    RANDOM_AZIMUTH = 3,         /* noise on the azimuth itself, not on the pointers */
    RANDOM_TRAFFIC = 5,         /* road users of random traffic: classes, places and speeds */
    RANDOM_FALSE_ALARMS = 9,    /* per scan: block 0 the number of false alarms, block n the place
                                 * of the n-th */
    RANDOM_CONDITIONS = 10,     /* road, weather and other radars of random traffic */
    RANDOM_SIGNAL = 14,         /* per scan: noise on two samples of its signal */
    RANDOM_BOOTSTRAP = 15,      /* which scenes a resample has (glint-score --ensemble) */
    RANDOM_SAMPLE = 16,         /* which frame of a stretch is in a sample; which targets a list
                                 * loses to give errors a scale (glint-cost) */
    RANDOM_VARIATION = 17,      /* values of a scenario that are distributions */
    RANDOM_ARRIVALS = 18,       /* vehicles that come to a lane: class, size, driver, when */
    RANDOM_ROADSIDE = 22,       /* per scene, strip and cell: what stands beside the road, with the
                                 * strip and the cell in place of frame, sensor and item */
    RANDOM_ROADSIDE_LEVEL = 23, /* per scene and scatterer beside the road: knots of its level */
    RANDOM_STRIPS = 24,         /* per snapshot: the strips beside its road */
    RANDOM_ELEMENTS = 25,       /* per cell: complex noise on the elements of an array */
    RANDOM_SURFACE = 26,        /* per scene, body and face: facing, level, height of scatterers */
    RANDOM_ELEVATION = 27,      /* noise on the elevation; per scan: that of the n-th false alarm */
    RANDOM_OWN = 1 << 16,       /* any number from here to 2^31 - 1 is free for stages outside this
                                 * tree, one for each purpose of the stages that run together */
};

struct random_address {
    uint64_t seed;
    uint64_t scene;  /* hash of the scene's name */
    uint64_t frame;  /* frame number */
    uint64_t sensor; /* hash of the sensor's name */
    uint64_t item;   /* hash of object, reflector and path; for a cell those of its leader */
};

/* The extremes of uniform draws. Results at these two draws bound the results of all draws. */
#define RANDOM_LEAST 0x1p-53
#define RANDOM_MOST (1 - 0x1p-53)

/* Four uniform draws in (0, 1), never 0 nor 1: (k + 1/2) 2^-52. index counts the blocks of four of
 * one purpose. */
void random_uniform(const struct random_address *address, enum random_purpose purpose,
                    uint32_t index, double uniform[4]);

/* Four independent standard Gaussian draws (Box and Muller), at most 8.57 in size. */
void random_gaussian(const struct random_address *address, enum random_purpose purpose,
                     uint32_t index, double gaussian[4]);

/* The first two of the draws of random_gaussian. */
void random_gaussian_pair(const struct random_address *address, enum random_purpose purpose,
                          uint32_t index, double gaussian[2]);

/* The value that a standard Gaussian exceeds with this probability in (0, 1), within 2e-7 of its
 * size or of 1: algorithm AS 241, PPND7 (Wichura 1988). It falls with the probability. */
double random_gaussian_exceeded(double probability);

/* The draws at one address, one after another. */
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

/* A gamma variate of this shape > 0 and scale 1, so with the shape as mean and variance (Marsaglia
 * and Tsang 2000). It may be 0 for shapes below 0.02. */
double random_gamma(struct random_sequence *sequence, double shape);

/* A Poisson count: the least k with P(N <= k) >= uniform in (0, 1), so it grows with that draw. A
 * mean above 1e9 counts as 1e9, one that is not positive as 0. The cost grows with the square root
 * of the mean. Probabilities are good to about 1e-13; tails beyond 2^-75 of the probability at the
 * mean are left out, because no uniform draw reaches them. */
int64_t random_poisson(double mean, double uniform);
