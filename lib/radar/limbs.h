/* Arms and legs of people who walk (EFFECTS 18, its cheap model): now and then a limb shows beside
 * the torso, faster or slower than it [A].
 *
 * A limb moves at (1 + x) times the torso's speed over ground: x = -1 for the foot that stands, 1.5
 * at the height of a swing, triangular in between with its peak at 0. */
#ifndef LIMBS_H
#define LIMBS_H

#include <stdint.h>

/* Of detections on one person, per scan; and their amplitude over the torso's, -6 dB. */
#define LIMBS_MEAN_COUNT 0.5
#define LIMBS_AMPLITUDE_FACTOR 0.501187233627272285002

/* A limb is at most this far ahead of the torso or behind it. */
#define LIMBS_REACH_M 0.35

struct limb {
    double swing;    /* x */
    double offset_m; /* along the person's heading */
};

/* Poisson. */
int64_t limbs_count(double uniform);

/* x by the first draw, the offset evenly by the second. */
struct limb limbs_limb(const double uniform[2]);

/* walking_mps is the part of the torso's range rate that its motion over ground makes: velocity
 * over ground along the sight line from the sensor. */
double limbs_range_rate_mps(double torso_mps, double walking_mps, struct limb limb);

#endif
