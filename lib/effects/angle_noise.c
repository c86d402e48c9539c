#include "effects/effect.h"

#include <complex.h>

#include "base/elementary.h"
#include "base/units.h"
#include "radar/interferer.h"

/* Equation (8): sum and delta channel get independent complex noise of the same RMS, pointer_sigma,
 * which other radars raise. */
static bool add_noise_to_pointers(const struct effect_scan *scan,
                                  struct effect_measurement *measurement)
{
    const double _Complex i = (double _Complex)I;
    if (measurement->cell->beam != NULL)
        return true; /* beam_cells_of added the noise */
    double sigma = scan->sensor->pointer_sigma * sqrt(0.5) *
                   interferer_noise_factor(measurement->cell->interference);
    double draw[4];
    random_gaussian(&measurement->address, RANDOM_POINTERS, 0, draw);
    measurement->pointers.sum += sigma * draw[0] + i * (sigma * draw[1]);
    measurement->pointers.delta += sigma * draw[2] + i * (sigma * draw[3]);
    return true;
}

/* Noise on the sine of the azimuth that an array reads of a single echo (MODEL 7.5). */
static void add_array_noise(const struct effect_scan *scan, struct effect_measurement *measurement,
                            double gaussian)
{
    const struct sensor *sensor = scan->sensor;
    double noise = sensor->pointer_sigma * interferer_noise_factor(measurement->cell->interference);
    double ratio = measurement->cell->sum_re / noise;
    double sine = elementary_sin(measurement->azimuth_rad) +
                  array_sigma(&sensor->beams, ratio * ratio) * gaussian;
    measurement->azimuth_rad = elementary_asin(elementary_max(elementary_min(sine, 1), -1));
}

/* Gaussian noise that no strength of an echo lessens (MODEL 14.7), independent of the pointers'. */
static bool add_noise_to_azimuth(const struct effect_scan *scan,
                                 struct effect_measurement *measurement)
{
    const struct sensor *sensor = scan->sensor;
    bool single = sensor->beams.count > 0 && measurement->cell->beam == NULL;
    if (!single && sensor->azimuth_floor_rad == 0)
        return false;
    double draw[2];
    random_gaussian_pair(&measurement->address, RANDOM_AZIMUTH, 0, draw);
    if (single && sensor->pointer_sigma > 0)
        add_array_noise(scan, measurement, draw[1]);
    double floor_rad = suite_azimuth_floor_rad(sensor, measurement->azimuth_rad);
    measurement->azimuth_rad = units_wrap_rad(measurement->azimuth_rad + floor_rad * draw[0]);
    return true;
}

const struct effect effect_angle_noise = {
    .summary = "noise on the sum and delta channels disturbs angle and amplitude; the angle's "
               "error has a floor",
    .cause = "pointer_sigma and azimuth_floor_rad of a sensor",
    .left_out_when = "the sensor's pointer_sigma and azimuth_floor_rad are 0",
    .cost = "four draws and an angle per cell, and two draws for the floor",
    .home = EFFECT_HOME_NOISE,
    .of_paper = true,
    .members = {{EFFECT_SENSOR(pointer_sigma)}, {EFFECT_SENSOR(azimuth_floor_rad)}},
    .purposes = {RANDOM_POINTERS, RANDOM_AZIMUTH, RANDOM_ELEMENTS},
    .measure[EFFECT_STEP_POINTERS] = add_noise_to_pointers,
    .measure[EFFECT_STEP_NOISE] = add_noise_to_azimuth,
};
