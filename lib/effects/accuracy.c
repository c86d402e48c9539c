/* The sensor's sigma_law sets the standard deviations of range and range rate by the amplitude of a
 * cell, divided by the factor by which other radars raise its noise (MODEL 9, 14.7):
 *     by_amplitude   those of the document times threshold / amplitude, at most 1;
 *     by_snr         those of radar/snr_sigma.h for the size of a resolution cell and the ratio
 *                    (amplitude / pointer_sigma)^2, with those of the document as floor. */
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
    struct snr_sigma law = {.cell = cell, .factor = sensor->window_factor, .floor = floor};
    return snr_sigma_of(&law, ratio * ratio);
}

static bool set_sigmas(const struct effect_scan *scan, struct effect_measurement *measurement)
{
    const struct sensor *sensor = scan->sensor;
    const struct cell *cell = measurement->cell;
    double amplitude = cell->amplitude / interferer_noise_factor(cell->interference);
    double share = elementary_min(sensor->threshold / amplitude, 1);
    double range_m = sensor->range_sigma_m, rate_mps = sensor->range_rate_sigma_mps;
    bool by_snr = sensor->sigma_law == SIGMA_BY_SNR;
    measurement->range_sigma_m =
        by_snr ? sigma_by_snr(sensor, amplitude, sensor->cell_range_m, range_m) : share * range_m;
    measurement->range_rate_sigma_mps =
        by_snr ? sigma_by_snr(sensor, amplitude, sensor->cell_range_rate_mps, rate_mps)
               : share * rate_mps;
    return measurement->range_sigma_m != range_m || measurement->range_rate_sigma_mps != rate_mps;
}

const struct effect effect_accuracy = {
    .summary = "range and range rate of a stronger cell have less noise",
    .cause = "sigma_law of a sensor",
    .left_out_when = "the sensor's sigma_law is fixed",
    .cost = "a division per cell",
    .home = EFFECT_HOME_NOISE,
    .described = described,
    .measure[EFFECT_STEP_SIGMA] = set_sigmas,
};
