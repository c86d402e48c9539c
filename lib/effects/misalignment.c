#include "effects/effect.h"

#include "radar/boresight_error.h"

static bool described(const struct effect_scan *scan)
{
    return scan->sensor->misalignment_rad != 0 || scan->sensor->radome_bias_rad > 0;
}

static bool turn(const struct effect_scan *scan, struct effect_measurement *measurement)
{
    const struct sensor *sensor = scan->sensor;
    struct boresight_error error = {
        .yaw_error_rad = sensor->misalignment_rad,
        .bias_rad = sensor->radome_bias_rad,
        .bias_period_rad = sensor->radome_period_rad,
        .bias_phase_rad = sensor->radome_phase_rad,
    };
    double azimuth_rad = measurement->azimuth_rad;
    measurement->azimuth_rad = boresight_error_reported_rad(&error, azimuth_rad);
    return measurement->azimuth_rad != azimuth_rad;
}

const struct effect effect_misalignment = {
    .summary = "the sensor looks aside of where it believes, through a bumper that bends the beam",
    .home = EFFECT_HOME_NOISE,
    .cause = "misalignment_rad, radome_bias_rad of a sensor",
    .bound = "both are 0",
    .cost = "a sine per cell",
    .described = described,
    .measure[EFFECT_STEP_AZIMUTH] = turn,
};
