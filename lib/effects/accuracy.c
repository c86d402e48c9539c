/* The standard deviations of range and range rate by the sensor's sigma_law, from the cell's
 * amplitude over its noise:
 *     by_amplitude   the document's times threshold / amplitude, at most 1;
 *     by_snr         radar/snr_sigma.h's, for the cell's size and (amplitude / pointer_sigma)^2,
 *                    with the document's as floor. */
#include "effects/effect.h"

#include "base/elementary.h"
#include "radar/interferer.h"
#include "radar/snr_sigma.h"

static bool described(const struct effect_scan *scan)
{
    return scan->sensor->sigma_law != SIGMA_FIXED;
}

static double sigma_by_snr(const struct sensor *sensor, double amplitude, double cell, double floor)
{
    double ratio = amplitude / sensor->pointer_sigma;
    struct snr_sigma accuracy = {.cell = cell, .factor = sensor->window_factor, .floor = floor};
    return snr_sigma_of(&accuracy, ratio * ratio);
}

static bool set_deviation(const struct effect_scan *scan, struct effect_measurement *measurement)
{
    const struct sensor *sensor = scan->sensor;
    const struct cell *cell = measurement->cell;
    double amplitude = cell->amplitude / interferer_noise_factor(cell->interference);
    double part = elementary_min(sensor->threshold / amplitude, 1);
    double range_m = sensor->range_sigma_m, rate_mps = sensor->range_rate_sigma_mps;
    bool by_snr = sensor->sigma_law == SIGMA_BY_SNR;
    measurement->range_sigma_m =
        by_snr ? sigma_by_snr(sensor, amplitude, sensor->cell_range_m, range_m) : part * range_m;
    measurement->range_rate_sigma_mps =
        by_snr ? sigma_by_snr(sensor, amplitude, sensor->cell_range_rate_mps, rate_mps)
               : part * rate_mps;
    return measurement->range_sigma_m != range_m || measurement->range_rate_sigma_mps != rate_mps;
}

const struct effect effect_accuracy = {
    .summary = "stronger cells are measured better",
    .home = EFFECT_HOME_NOISE,
    .cause = "sigma_law of a sensor",
    .bound = "sigma_law is fixed",
    .cost = "a division per cell",
    .described = described,
    .measure[EFFECT_STEP_DEVIATION] = set_deviation,
};
