#include "effects/effect.h"

#include "base/elementary.h"

static bool described(const struct effect_scan *scan)
{
    const struct sensor *sensor = scan->sensor;
    return sensor->range_sigma_m > 0 || sensor->range_sigma_share > 0 ||
           sensor->range_rate_sigma_mps > 0 || sensor->sigma_law == SIGMA_BY_SNR;
}

/* Gaussian noise on range and range rate (MODEL 9); a range below 0 becomes 0. */
static bool add_noise(const struct effect_scan *scan, struct effect_measurement *measurement)
{
    double draw[2];
    effect_measure(scan, EFFECT_STEP_SIGMA, measurement);
    measurement->range_sigma_m =
        suite_range_sigma_m(scan->sensor, measurement->range_m, measurement->range_sigma_m);
    random_gaussian_pair(&measurement->address, RANDOM_RANGE_RATE, 0, draw);
    measurement->range_m =
        elementary_max(measurement->range_m + measurement->range_sigma_m * draw[0], 0);
    measurement->range_rate_mps += measurement->range_rate_sigma_mps * draw[1];
    return measurement->range_m != measurement->cell->range_m ||
           measurement->range_rate_mps != measurement->cell->range_rate_mps;
}

const struct effect effect_range_noise = {
    .summary = "noise disturbs range and range rate",
    .cause = "range_sigma_m, range_sigma_share and range_rate_sigma_mps of a sensor",
    .left_out_when =
        "the sensor's range_sigma_m, range_sigma_share and range_rate_sigma_mps are 0 and its "
        "sigma_law is not by_snr",
    .cost = "two draws per cell",
    .home = EFFECT_HOME_NOISE,
    .of_paper = true,
    .members = {{EFFECT_SENSOR(range_sigma_m)},
                {EFFECT_SENSOR(range_sigma_share)},
                {EFFECT_SENSOR(range_rate_sigma_mps)},
                {EFFECT_SENSOR(sigma_law)}},
    .described = described,
    .purposes = {RANDOM_RANGE_RATE},
    .measure[EFFECT_STEP_NOISE] = add_noise,
};
