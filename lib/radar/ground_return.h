/* Echoes of nothing and of the standing world (EFFECTS 9, 14): false alarms and clutter. How many
 * there are is poisson.h's; here is what each of them is like. Uniforms are in (0, 1), amplitudes
 * linear, noise_sigma is the RMS of the complex noise on the sum channel. */
#ifndef GROUND_RETURN_H
#define GROUND_RETURN_H

#include "base/vec2.h"

/* The amplitude of noise that has passed the threshold. Its power is without memory,
 * threshold^2 + sigma^2 Exp(1), so this is threshold itself without noise. */
double noise_targets_amplitude(double threshold, double noise_sigma, double uniform);

/* The area that a sensor sees between two ranges; times a density per m^2 it is a mean count. */
double ground_return_area_m2(double range_min_m, double range_max_m, double field_of_view_rad);

/* The range of a place drawn evenly over that area; its azimuth is even over the field of view. */
double ground_return_range_m(double range_min_m, double range_max_m, double uniform);

/* The range rate of what stands on the ground in that azimuth, from the velocity of the sensor
 * itself (mount and turn rate included, motion_velocity_at): -v_s · u. */
double ground_return_range_rate_mps(struct vec2 sensor_mps, struct vec2 boresight,
                                    double azimuth_rad);

#endif
