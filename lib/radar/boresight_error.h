/* Azimuth that a misaligned sensor behind a bumper reports (MODEL 14.8).
 *
 * The sensor looks to the right of where it believes by the yaw error; the bumper, as a radome,
 * bends the beam by the bias, with periods of 20 to 40 degrees in practice. */
#pragma once

struct boresight_error {
    double yaw_error_rad;
    double bias_rad;
    double bias_period_rad; /* > 0 unless bias_rad is 0 */
    double bias_phase_rad;
};

/* The reported azimuth, in (-pi, pi]. Without yaw error and bias it is azimuth_rad itself, if that
 * is in this interval. */
double boresight_error_reported_rad(const struct boresight_error *error, double azimuth_rad);
