/* Micro-Doppler of rolling wheels (EFFECTS 8).
 *
 * A point of a wheel at the fraction rho of its radius and the angle psi from the top moves forward
 * at v (1 + rho cos psi) when the vehicle does at v: the contact point stands, the top is twice as
 * fast. Seen from the road's height, the range rate of the point is that of the hub plus rho cos
 * psi times what the vehicle's speed over ground adds to it. */
#ifndef WHEEL_H
#define WHEEL_H

#include <stdint.h>

/* Of detections on one wheel that is in sight, per scan; and their amplitude over that of a corner
 * of the body, -10 dB [A]. */
#define WHEEL_MEAN_COUNT 1.5
#define WHEEL_AMPLITUDE_FACTOR 0.316227766016837933200

struct wheel_point {
    double fraction;  /* rho */
    double angle_rad; /* psi, 0 at the top */
};

/* Poisson. */
int64_t wheel_count(double uniform);

/* rho evenly from 0.3 to 1 by the first draw, psi evenly around the wheel by the second [A]. */
struct wheel_point wheel_point(const double uniform[2]);

/* hub_mps is the hub's range rate, rolling_mps the part of it that its motion over ground makes:
 * ground velocity of the hub along the sight line from the sensor, v cos alpha. */
double wheel_range_rate_mps(double hub_mps, double rolling_mps, struct wheel_point point);

#endif
