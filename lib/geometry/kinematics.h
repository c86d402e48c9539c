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

/* The path to a reflector above or below the sensor (MODEL 14.2): its range is larger than in the
 * plane, the range rate smaller, the echo weaker. A linear array measures the angle of a cone,
 * sin(measured azimuth) = sin(azimuth) cos(elevation). */
struct slant {
    double range_m; /* slant */
    /* Sine and cosine of the elevation, positive upwards. Range rates in the plane are multiplied
     * by the cosine. */
    double sine, cosine;
};

/* distance_m >= 0 is the range in the plane, height_m the reflector's height less the sensor's. The
 * elevation is 0 where both are 0. At equal heights the range is exactly the distance, and the
 * cosine 1. */
struct slant kinematics_slant(double distance_m, double height_m);

/* The azimuth in [-pi, pi] that a linear array measures of a reflector at this azimuth in the
 * plane, within 4 ulp. It lies on the same side of the array (0 and pi/2 stay), at most 90 deg less
 * the elevation from boresight. At elevation 0 it is exactly the azimuth. */
double kinematics_slant_azimuth_rad(struct slant elevation, double azimuth_rad);

/* The two-way factor on amplitude of a beam that is Gaussian in elevation,
 * 2^-(elevation/half_width)^2. At half_width_rad > 0 (5 to 10 deg for radars of cars, assumed) the
 * one-way power is down by 3.01 dB. The two-way factor on amplitude equals the one-way factor on
 * power. */
double kinematics_slant_amplitude_factor(struct slant elevation, double half_width_rad);
