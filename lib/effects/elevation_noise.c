/* Noise on the elevation by the amplitude of the target, divided by the factor by which other
 * radars raise the sensor's noise, with a floor (MODEL 7.6). */
#include "effects/effect.h"

#include "base/elementary.h"
#include "base/units.h"
#include "radar/interferer.h"

static bool add_noise(const struct effect_scan *scan, struct effect_measurement *measurement)
{
    double amplitude =
        measurement->amplitude / interferer_noise_factor(measurement->cell->interference);
    double sigma_rad = suite_elevation_sigma_rad(scan->sensor, amplitude), draw[2];
    random_gaussian_pair(&measurement->address, RANDOM_ELEVATION, 0, draw);
    double elevation_rad = measurement->elevation_rad + sigma_rad * draw[0];
    measurement->elevation_rad = elementary_max(elementary_min(elevation_rad, PI / 2), -PI / 2);
    measurement->elevation_sigma_rad = sigma_rad;
    return true;
}

const struct effect effect_elevation_noise = {
    .summary = "noise disturbs the elevation, the more the weaker a target; its error has a floor",
    .cause = "elevation_sigma_rad and elevation_floor_rad of a sensor",
    .left_out_when = "the sensor's elevation_sigma_rad and elevation_floor_rad are 0",
    .cost = "two draws per cell",
    .home = EFFECT_HOME_NOISE,
    .members = {{EFFECT_SENSOR(elevation_sigma_rad)}, {EFFECT_SENSOR(elevation_floor_rad)}},
    .purposes = {RANDOM_ELEVATION},
    .measure[EFFECT_STEP_ANGLES] = add_noise,
};
