#include "noise/measurement_noise.h"

#include <complex.h>
#include <math.h>

#include "base/elementary.h"
#include "radar/boresight_error.h"
#include "radar/interferer.h"
#include "radar/snr_sigma.h"

static bool on(const struct selection *selection, enum effect effect, bool described)
{
    bool simulated = described && effects_enabled(selection, effect);
    effects_note(selection, effect, simulated);
    return simulated;
}

struct measurement_noise measurement_noise_of(const struct sensor *sensor,
                                              const struct selection *selection)
{
    bool range = sensor->range_sigma_m > 0 || sensor->range_rate_sigma_mps > 0 ||
                 sensor->sigma_law == SIGMA_BY_SNR;
    bool turned = sensor->misalignment_rad != 0 || sensor->radome_bias_rad > 0;
    bool steps =
        sensor->range_step_m > 0 || sensor->range_rate_step_mps > 0 || sensor->azimuth_step_rad > 0;
    bool alarms = on(selection, EFFECT_FALSE_ALARMS, sensor->false_alarms > 0);
    bool limit = on(selection, EFFECT_LIST_LIMIT, sensor->list_limit > 0);
    return (struct measurement_noise){
        .sensor = sensor,
        .pointers = on(selection, EFFECT_ANGLE_NOISE, sensor->pointer_sigma > 0),
        .range = on(selection, EFFECT_RANGE_NOISE, range),
        .accuracy = on(selection, EFFECT_ACCURACY, sensor->sigma_law != SIGMA_FIXED),
        .misalignment = on(selection, EFFECT_MISALIGNMENT, turned),
        .final_threshold = on(selection, EFFECT_FINAL_THRESHOLD, sensor->final_threshold),
        .steps = on(selection, EFFECT_QUANTISATION, steps),
        .false_alarms = alarms ? sensor->false_alarms : 0,
        .list_limit = limit ? sensor->list_limit : 0,
    };
}

struct antenna_pointers measurement_noise_pointers(const struct measurement_noise *by,
                                                   const struct random_address *address,
                                                   const struct cell *cell)
{
    struct antenna_pointers pointers = frame_cell_pointers(cell);
    double draw[4],
        sigma = by->sensor->pointer_sigma * sqrt(0.5) * interferer_noise_factor(cell->interference);
    if (!by->pointers)
        return pointers;
    random_gaussian(address, RANDOM_POINTERS, 0, draw);
    const double _Complex i = (double _Complex)I;
    pointers.sum += sigma * draw[0] + i * (sigma * draw[1]);
    pointers.delta += sigma * draw[2] + i * (sigma * draw[3]);
    return pointers;
}

static double sigma_by_snr(const struct sensor *sensor, double amplitude, double cell, double floor)
{
    double ratio = amplitude / sensor->pointer_sigma;
    struct snr_sigma accuracy = {.cell = cell, .factor = sensor->window_factor, .floor = floor};
    return snr_sigma_of(&accuracy, ratio * ratio);
}

struct deviation measurement_noise_deviation(const struct measurement_noise *by,
                                             const struct cell *cell)
{
    const struct sensor *sensor = by->sensor;
    double amplitude = cell->amplitude / interferer_noise_factor(cell->interference);
    struct deviation fixed = {sensor->range_sigma_m, sensor->range_rate_sigma_mps};
    if (!by->accuracy)
        return fixed;
    if (sensor->sigma_law == SIGMA_BY_SNR)
        return (struct deviation){
            sigma_by_snr(sensor, amplitude, sensor->cell_range_m, fixed.range_m),
            sigma_by_snr(sensor, amplitude, sensor->cell_range_rate_mps, fixed.range_rate_mps)};
    double part = elementary_min(sensor->threshold / amplitude, 1);
    return (struct deviation){part * fixed.range_m, part * fixed.range_rate_mps};
}

void measurement_noise_range(const struct measurement_noise *by,
                             const struct random_address *address, struct measurement *measurement)
{
    const struct sensor *sensor = by->sensor;
    double draw[2];
    if (!by->range)
        return;
    struct deviation sigma = measurement_noise_deviation(by, measurement->cell);
    random_gaussian_pair(address, RANDOM_RANGE_RATE, 0, draw);
    measurement->range_m = elementary_max(measurement->range_m + sigma.range_m * draw[0], 0);
    measurement->range_rate_mps += sigma.range_rate_mps * draw[1];
    if (measurement->range_m != measurement->cell->range_m ||
        measurement->range_rate_mps != measurement->cell->range_rate_mps)
        measurement->effects |= EFFECT_BIT(EFFECT_RANGE_NOISE);
    if (sigma.range_m != sensor->range_sigma_m ||
        sigma.range_rate_mps != sensor->range_rate_sigma_mps)
        measurement->effects |= EFFECT_BIT(EFFECT_ACCURACY);
}

void measurement_noise_azimuth(const struct measurement_noise *by, struct measurement *measurement)
{
    const struct sensor *sensor = by->sensor;
    if (!by->misalignment)
        return;
    struct boresight_error misalignment = {
        .yaw_error_rad = sensor->misalignment_rad,
        .bias_rad = sensor->radome_bias_rad,
        .bias_period_rad = sensor->radome_period_rad,
        .bias_phase_rad = sensor->radome_phase_rad,
    };
    double azimuth_rad = boresight_error_reported_rad(&misalignment, measurement->azimuth_rad);
    if (azimuth_rad != measurement->azimuth_rad)
        measurement->effects |= EFFECT_BIT(EFFECT_MISALIGNMENT);
    measurement->azimuth_rad = azimuth_rad;
}
