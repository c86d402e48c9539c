/* Random points on the ground in view of a sensor.
 *
 * Points are distributed evenly over the area between two ranges within the field of view (MODEL
 * 14.13). */
#pragma once

#include "base/vec2.h"

/* The area in view between two ranges: (R_max^2 - R_min^2) times half the field of view. A density
 * per m^2 times this area is a mean count. */
double ground_return_area_m2(double range_min_m, double range_max_m, double field_of_view_rad);

/* The range of a point of that area, from a uniform number in (0, 1). */
double ground_return_range_m(double range_min_m, double range_max_m, double uniform);

/* The range rate of a standing point at an azimuth from boresight: -v · u, with the velocity v of
 * the sensor itself (kinematics.h) and the unit vector u to the point. */
double ground_return_range_rate_mps(struct vec2 sensor_mps, struct vec2 boresight,
                                    double azimuth_rad);
