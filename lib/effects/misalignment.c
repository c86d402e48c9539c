/* A yaw error of the mount, and a bias by the radome (MODEL 14.8). */
#include "effects/effect.h"

#include "radar/antenna.h"

static bool turn_azimuth(const struct effect_scan *scan, struct effect_measurement *measurement)
{
    const struct sensor *sensor = scan->sensor;
    struct boresight_error error = {
        .yaw_error_rad = sensor->misalignment_rad,
        .bias_rad = sensor->radome_bias_rad,
        .bias_period_rad = sensor->radome_period_rad,
        .bias_phase_rad = sensor->radome_phase_rad,
    };
    double azimuth_rad = measurement->azimuth_rad;
    measurement->azimuth_rad = antenna_reported_rad(&error, azimuth_rad);
    return measurement->azimuth_rad != azimuth_rad;
}

const struct effect effect_misalignment = {
    .summary =
        "the azimuth is wrong if the sensor is turned in its mount or a bumper bends its beam",
    .cause = "misalignment_rad and radome_bias_rad of a sensor",
    .left_out_when = "the sensor's misalignment_rad and radome_bias_rad are 0",
    .cost = "a sine per cell",
    .home = EFFECT_HOME_NOISE,
    .members = {{EFFECT_SENSOR(misalignment_rad)}, {EFFECT_SENSOR(radome_bias_rad)}},
    .measure[EFFECT_STEP_ANGLES] = turn_azimuth,
};
