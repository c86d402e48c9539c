/* The sensor's sigma_law sets the standard deviations of range and range rate by the amplitude of a
 * cell, divided by the factor by which other radars raise its noise (MODEL 9, 14.7). */
#include "effects/effect.h"

#include "radar/interferer.h"

static bool set_sigmas(const struct effect_scan *scan, struct effect_measurement *measurement)
{
    const struct sensor *sensor = scan->sensor;
    const struct cell *cell = measurement->cell;
    double amplitude = cell->amplitude / interferer_noise_factor(cell->interference);
    measurement->range_sigma_m = measurement_sigma_at(&sensor->range_error, amplitude);
    measurement->range_rate_sigma_mps = measurement_sigma_at(&sensor->range_rate_error, amplitude);
    return measurement->range_sigma_m != sensor->range_sigma_m ||
           measurement->range_rate_sigma_mps != sensor->range_rate_sigma_mps;
}

const struct effect effect_accuracy = {
    .summary = "range and range rate of a stronger cell have less noise",
    .cause = "sigma_law of a sensor",
    .left_out_when = "the sensor's sigma_law is fixed",
    .cost = "a division per cell",
    .home = EFFECT_HOME_NOISE,
    .members = {{EFFECT_SENSOR(sigma_law)}},
    .measure[EFFECT_STEP_SIGMA] = set_sigmas,
};
