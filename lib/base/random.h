/* Random numbers by address, never by order (Philox4x64, Random123).
 *
 * A draw is a function of where it belongs: the seed, the scene, the frame, the sensor, the
 * reflector and what it is for. So no draw depends on what else was drawn: not on sharding, on the
 * order of objects, on effects that were left out, nor on piped or fused. */
#ifndef RANDOM_H
#define RANDOM_H

#include <stdint.h>

/* What a draw is for. New purposes go at the end: numbers are part of every data set made. */
enum random_purpose {
    RANDOM_POINTERS = 1,        /* complex noise on sum and delta: four Gaussians */
    RANDOM_RANGE_RATE = 2,      /* noise on range and range rate */
    RANDOM_AZIMUTH = 3,         /* noise on azimuth (glint-noise-gauss) */
    RANDOM_PHASE = 4,           /* relative phase of an echo */
    RANDOM_TRAFFIC = 5,         /* who is there in a random scene, where and how fast */
    RANDOM_HARD_CASE = 6,       /* which hard cases a random scene has */
    RANDOM_REFLECTOR_PHASE = 7, /* what a reflector adds to the phase of its path */
    RANDOM_FLUCTUATION = 8,     /* an echo's strength in this scan */
    RANDOM_FALSE_ALARMS = 9,    /* of a scan: block 0 how many, block n where the n-th is */
    RANDOM_CONDITIONS = 10,     /* road, weather and other radars of a random scene */
    RANDOM_WHEELS = 11,         /* of a wheel house: the same of points on its wheel */
    RANDOM_LIMBS = 12,          /* of a person: the same of arms and legs */
    RANDOM_CLUTTER = 13,        /* of a scan: the same of points on the ground */
    RANDOM_SIGNAL = 14,         /* of a scan: noise on two samples of its signal */
};

struct random_address {
    uint64_t seed;
    uint64_t scene;  /* hash of the scene's name */
    uint64_t frame;  /* frame number */
    uint64_t sensor; /* hash of the sensor's name */
    uint64_t item;   /* hash of object, reflector and path; a cell draws by its leader */
};

/* The extremes of uniform draws: what a draw can lead to is bounded by what these lead to. */
#define RANDOM_LEAST 0x1p-53
#define RANDOM_MOST (1 - 0x1p-53)

/* Four uniform draws in (0, 1), never 0 nor 1: (k + 1/2) 2^-52 (NUMERICS 48, 49). index counts the
 * blocks of one purpose. */
void random_uniform(const struct random_address *address, enum random_purpose purpose,
                    uint32_t index, double uniform[4]);

/* Four independent standard Gaussian draws (Box and Muller), at most 8.57 in size. */
void random_gaussian(const struct random_address *address, enum random_purpose purpose,
                     uint32_t index, double gaussian[4]);

/* The first two of these. */
void random_gaussian_pair(const struct random_address *address, enum random_purpose purpose,
                          uint32_t index, double gaussian[2]);

#endif
