/* Range, azimuth and range rate of a moving point. Azimuth counts from boresight, left positive;
 * range rate is positive where the point recedes (MODEL 2.4, 5). */
#pragma once

#include "base/vec2.h"

struct kinematics {
    double range_m;
    double azimuth_rad;    /* (-pi, pi]; 0 if range_m is 0 */
    double range_rate_mps; /* 0 if range_m is 0 */
};

/* The kinematics of a point that moves with point_mps, seen by a sensor that moves with sensor_mps;
 * boresight is a unit vector. The range rate is (v · r) / R with exact products, so that nearly
 * tangential motion keeps its sign. */
struct kinematics kinematics_of(struct vec2 sensor_m, struct vec2 sensor_mps, struct vec2 boresight,
                                struct vec2 point_m, struct vec2 point_mps);
