#include "measurement_noise.h"

#include <complex.h>
#include <math.h>

#include "accuracy.h"
#include "elementary.h"
#include "interference.h"
#include "misalignment.h"
#include "superposition.h"

static bool on(const struct selection *selection, enum effect effect, bool described)
{
    bool simulated = described && effects_may(selection, effect);
    effects_note(selection, effect, simulated);
    return simulated;
}

struct measurement_noise measurement_noise_of(const struct sensor *sensor, const struct selection *selection)
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
    struct antenna_pointers pointers = superposition_pointers(cell);
    double draw[4], sigma = by->sensor->pointer_sigma * sqrt(0.5) *
                            interference_noise_factor(cell->interference);
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
    struct accuracy accuracy = {.cell = cell, .factor = sensor->window_factor, .floor = floor};
    return accuracy_sigma(&accuracy, ratio * ratio);
}

struct deviation measurement_noise_deviation(const struct measurement_noise *by, const struct cell *cell)
{
    const struct sensor *sensor = by->sensor;
    double amplitude = cell->amplitude / interference_noise_factor(cell->interference);
    struct deviation fixed = {sensor->range_sigma_m, sensor->range_rate_sigma_mps};
    if (!by->accuracy)
        return fixed;
    if (sensor->sigma_law == SIGMA_BY_SNR)
        return (struct deviation){
            sigma_by_snr(sensor, amplitude, sensor->cell_range_m, fixed.range_m),
            sigma_by_snr(sensor, amplitude, sensor->cell_range_rate_mps, fixed.range_rate_mps)};
    double part = elementary_least(sensor->threshold / amplitude, 1);
    return (struct deviation){part * fixed.range_m, part * fixed.range_rate_mps};
}

void measurement_noise_range(const struct measurement_noise *by, const struct random_address *address,
                       struct reading *reading)
{
    const struct sensor *sensor = by->sensor;
    double draw[2];
    if (!by->range)
        return;
    struct deviation sigma = measurement_noise_deviation(by, reading->cell);
    random_gaussian_pair(address, RANDOM_RANGE_RATE, 0, draw);
    reading->range_m = elementary_most(reading->range_m + sigma.range_m * draw[0], 0);
    reading->range_rate_mps += sigma.range_rate_mps * draw[1];
    if (reading->range_m != reading->cell->range_m ||
        reading->range_rate_mps != reading->cell->range_rate_mps)
        reading->effects |= EFFECT_BIT(EFFECT_RANGE_NOISE);
    if (sigma.range_m != sensor->range_sigma_m ||
        sigma.range_rate_mps != sensor->range_rate_sigma_mps)
        reading->effects |= EFFECT_BIT(EFFECT_ACCURACY);
}

void measurement_noise_azimuth(const struct measurement_noise *by, struct reading *reading)
{
    const struct sensor *sensor = by->sensor;
    if (!by->misalignment)
        return;
    struct misalignment misalignment = {
        .yaw_error_rad = sensor->misalignment_rad,
        .bias_rad = sensor->radome_bias_rad,
        .bias_period_rad = sensor->radome_period_rad,
        .bias_phase_rad = sensor->radome_phase_rad,
    };
    double azimuth_rad = misalignment_reported_rad(&misalignment, reading->azimuth_rad);
    if (azimuth_rad != reading->azimuth_rad)
        reading->effects |= EFFECT_BIT(EFFECT_MISALIGNMENT);
    reading->azimuth_rad = azimuth_rad;
}
