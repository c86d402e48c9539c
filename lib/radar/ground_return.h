/* Places spread evenly over the ground that a sensor sees, and the range rate of what stands there.
 * How many places there are is poisson.h's. Uniforms are in (0, 1). */
#ifndef GROUND_RETURN_H
#define GROUND_RETURN_H

#include "base/vec2.h"

/* The area that a sensor sees between two ranges; times a density per m^2 it is a mean count. */
double ground_return_area_m2(double range_min_m, double range_max_m, double field_of_view_rad);

/* The range of a place drawn evenly over that area; its azimuth is even over the field of view. */
double ground_return_range_m(double range_min_m, double range_max_m, double uniform);

/* The range rate of what stands on the ground in that azimuth, from the velocity of the sensor
 * itself (mount and turn rate included, motion_velocity_at): -v_s · u. */
double ground_return_range_rate_mps(struct vec2 sensor_mps, struct vec2 boresight,
                                    double azimuth_rad);

#endif
