/* What an ideal radar would read off one reflecting point (MODEL 2.4, 5): range, azimuth from
 * boresight (left positive) and range rate (receding positive). */
#ifndef KINEMATICS_H
#define KINEMATICS_H

#include "base/vec2.h"

struct kinematics {
    double range_m;
    double azimuth_rad;    /* (-pi, pi]; 0 if range_m is 0 */
    double range_rate_mps; /* 0 if range_m is 0 */
};

/* A point moving with point_mps seen by a sensor moving with sensor_mps; boresight is a unit
 * vector. The range rate is (v · r) / R with the products exact, so that nearly tangential motion
 * keeps its sign (NUMERICS 35). */
struct kinematics kinematics_of(struct vec2 sensor_m, struct vec2 sensor_mps, struct vec2 boresight,
                                struct vec2 point_m, struct vec2 point_mps);

#endif
