/* A sensor that does not look where it believes, and a bumper that bends its beam (EFFECTS 14):
 *     reported azimuth = true azimuth + yaw error + bias sin(2 pi azimuth / period + phase).
 * The bias is fixed for a sensor; its period is 20 to 40 degrees in practice. Radians throughout.
 */
#ifndef BORESIGHT_ERROR_H
#define BORESIGHT_ERROR_H

struct boresight_error {
    double yaw_error_rad;
    double bias_rad;
    double bias_period_rad; /* > 0, unless the bias is 0 */
    double bias_phase_rad;
};

/* In (-pi, pi]. Without error and bias the azimuth itself, if it is in there. */
double boresight_error_reported_rad(const struct boresight_error *misalignment, double azimuth_rad);

#endif
