/* Range rates of points on rolling wheels and swinging limbs.
 *
 * A point of a wheel stands at the road and is twice as fast as the vehicle at the top (MODEL
 * 14.11). An arm or a leg of a walking person moves at (1 + x) times the torso's speed over ground,
 * x of a triangular law from -1 to 1.5 with its peak at 0 (MODEL 14.12, assumed). */
#pragma once

/* The mean of the Poisson number of echoing points on a visible wheel in a scan, and their
 * amplitude over the amplitude of the wheel's own echo, -10 dB; both assumed. */
#define MICRO_DOPPLER_WHEEL_COUNT 1.5
#define MICRO_DOPPLER_WHEEL_FACTOR 0.316227766016837933200

/* Wheels and limbs whose motion over ground changes the range by this speed or less echo with their
 * body alone; from the second speed on their parts have their full amplitude. Both are assumed. */
#define MICRO_DOPPLER_STILL_MPS 0.05
#define MICRO_DOPPLER_FULL_MPS 0.5

/* The share of their amplitude that parts have at this rate over ground, of either sign: 0 to 1,
 * linear between the two speeds, so that no rounding of a speed makes another echo. */
double micro_doppler_share(double ground_mps);

struct wheel_point {
    double fraction;  /* rho */
    double angle_rad; /* psi, 0 at the top */
};

/* A point with rho even over 0.3 to 1 and psi even around the wheel, from two uniform numbers. */
struct wheel_point micro_doppler_wheel_point(const double uniform[2]);

/* The range rate of a point. hub_mps is the hub's range rate, rolling_mps the part of it that the
 * hub's motion over ground makes: its velocity over ground along the sight line. */
double micro_doppler_wheel_rate_mps(double hub_mps, double rolling_mps, struct wheel_point point);

/* The mean of the Poisson number of echoing limbs of a person in a scan, and their amplitude over
 * the torso's, -6 dB; both assumed. */
#define MICRO_DOPPLER_LIMB_COUNT 0.5
#define MICRO_DOPPLER_LIMB_FACTOR 0.501187233627272285002

/* The farthest that a limb is ahead of the torso or behind it. */
#define MICRO_DOPPLER_LIMB_REACH_M 0.35

struct limb {
    double swing;    /* x */
    double offset_m; /* along the person's heading */
};

/* A limb with x and an even offset, each from one uniform number. */
struct limb micro_doppler_limb(const double uniform[2]);

/* The range rate of a limb. torso_mps is the torso's range rate, walking_mps the part of it that
 * the torso's motion over ground makes. */
double micro_doppler_limb_rate_mps(double torso_mps, double walking_mps, struct limb limb);
