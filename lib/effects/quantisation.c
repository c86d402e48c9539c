/* Rounding of reported values to the sensor's steps (MODEL 9). */
#include "effects/effect.h"

#include "base/units.h"

static bool round_values(const struct effect_scan *scan, struct effect_measurement *measurement)
{
    const struct sensor *sensor = scan->sensor;
    double range_m = measurement->range_m;
    double azimuth_rad = measurement->azimuth_rad;
    double elevation_rad = measurement->elevation_rad;
    double rate_mps = measurement->range_rate_mps;
    measurement->range_m = units_rounded(range_m, sensor->range_step_m);
    measurement->azimuth_rad = units_wrap_rad(units_rounded(azimuth_rad, sensor->azimuth_step_rad));
    measurement->elevation_rad = units_rounded(elevation_rad, sensor->elevation_step_rad);
    measurement->range_rate_mps = units_rounded(rate_mps, sensor->range_rate_step_mps);
    return measurement->range_m != range_m || measurement->azimuth_rad != azimuth_rad ||
           measurement->elevation_rad != elevation_rad || measurement->range_rate_mps != rate_mps;
}

const struct effect effect_quantisation = {
    .summary = "reported values are multiples of a step",
    .cause =
        "range_step_m, range_rate_step_mps, azimuth_step_rad and elevation_step_rad of a sensor",
    .left_out_when = "all four steps of the sensor are 0",
    .cost = "four roundings per target",
    .home = EFFECT_HOME_NOISE,
    .members = {{EFFECT_SENSOR(range_step_m)},
                {EFFECT_SENSOR(range_rate_step_mps)},
                {EFFECT_SENSOR(azimuth_step_rad)},
                {EFFECT_SENSOR(elevation_step_rad)}},
    .measure[EFFECT_STEP_ROUNDING] = round_values,
};
