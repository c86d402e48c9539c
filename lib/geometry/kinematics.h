/* Sensor pose; range, azimuth and range rate of moving points. Azimuth counts from boresight, left
 * positive; range rate is positive where the point recedes (MODEL 2.4, 5). */
#pragma once

#include "geometry/motion.h"

/* A sensor on the ego, in the coordinates of the ego's motion. */
struct sensor_pose {
    struct vec2 position_m;
    struct vec2 velocity_mps; /* includes what the ego's turn rate adds at the mount */
    struct vec2 boresight;    /* unit vector */
    double yaw_rad;           /* of the boresight, not wrapped */
};

/* The mount is given from the centre of the ego's box, in the ego's own frame. */
struct sensor_pose kinematics_sensor_pose(const struct motion *ego, double mount_x_m,
                                          double mount_y_m, double mount_yaw_rad);

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

/* A reflector above or below the sensor is farther away than in the plane, its range rate is
 * smaller, its echo weaker, and a linear array reads the angle of a cone, sin(azimuth read) =
 * sin(azimuth) cos(elevation) (MODEL 14.2). */
struct slant {
    double range_m; /* slant */
    /* Sine and cosine of the elevation, positive upwards. Range rates in the plane are multiplied
     * by the cosine. */
    double sine, cosine;
};

/* distance_m >= 0 is the range in the plane, height_m the reflector's height less the sensor's. The
 * elevation is 0 where both are 0. At equal heights the range is the distance, bit by bit, and the
 * cosine 1. */
struct slant kinematics_slant(double distance_m, double height_m);

/* The azimuth that a linear array reads of a reflector at this azimuth in the plane, in [-pi, pi].
 * It lies on the same side of the array, 0 and pi/2 included, and never beyond 90 deg less the
 * elevation. Bit by bit the same at elevation 0. Within 4 ulp. */
double kinematics_slant_azimuth_rad(struct slant elevation, double azimuth_rad);

/* The factor on amplitude of a beam that is Gaussian in elevation, for both ways together:
 * 2^-(elevation/half_width)^2. One way the beam is down by half in power, 3.01 dB, at
 * half_width_rad > 0 (5 to 10 deg for radars of cars, assumed); both ways double the decibels, so
 * the factor on amplitude is the one-way factor on power. */
double kinematics_slant_amplitude_factor(struct slant elevation, double half_width_rad);
