/* Micro-Doppler: parts of an object that move at other rates than its body.
 *
 * Rolling wheels. A point of a wheel at the fraction rho of its radius and the angle psi from the
 * top moves forward at v (1 + rho cos psi) when the vehicle does at v: the contact point stands,
 * the top is twice as fast. Seen from the height of the road, the range rate of the point is that
 * of the hub plus rho cos psi times what the vehicle's speed over ground adds to it.
 *
 * Limbs of people who walk, a cheap model [A]: now and then an arm or a leg shows beside the torso,
 * faster or slower than it. A limb moves at (1 + x) times the torso's speed over ground: x = -1 for
 * the foot that stands, 1.5 at the height of a swing, triangular in between with its peak at 0. */
#ifndef MICRO_DOPPLER_H
#define MICRO_DOPPLER_H

#include <stdint.h>

/* Of detections on one wheel that is in sight, per scan; and their amplitude over that of a corner
 * of the body, -10 dB [A]. */
#define MICRO_DOPPLER_WHEEL_COUNT 1.5
#define MICRO_DOPPLER_WHEEL_FACTOR 0.316227766016837933200

struct wheel_point {
    double fraction;  /* rho */
    double angle_rad; /* psi, 0 at the top */
};

/* Poisson. */
int64_t micro_doppler_wheel_count(double uniform);

/* rho evenly from 0.3 to 1 by the first draw, psi evenly around the wheel by the second [A]. */
struct wheel_point micro_doppler_wheel_point(const double uniform[2]);

/* hub_mps is the hub's range rate, rolling_mps the part of it that its motion over ground makes:
 * ground velocity of the hub along the sight line from the sensor, v cos alpha. */
double micro_doppler_wheel_rate_mps(double hub_mps, double rolling_mps, struct wheel_point point);

/* Of detections on one person, per scan; and their amplitude over the torso's, -6 dB. */
#define MICRO_DOPPLER_LIMB_COUNT 0.5
#define MICRO_DOPPLER_LIMB_FACTOR 0.501187233627272285002

/* A limb is at most this far ahead of the torso or behind it. */
#define MICRO_DOPPLER_LIMB_REACH_M 0.35

struct limb {
    double swing;    /* x */
    double offset_m; /* along the person's heading */
};

/* Poisson. */
int64_t micro_doppler_limb_count(double uniform);

/* x by the first draw, the offset evenly by the second. */
struct limb micro_doppler_limb(const double uniform[2]);

/* walking_mps is the part of the torso's range rate that its motion over ground makes: velocity
 * over ground along the sight line from the sensor. */
double micro_doppler_limb_rate_mps(double torso_mps, double walking_mps, struct limb limb);

#endif
