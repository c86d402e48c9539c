/* Attenuation by snow by Gunn and East 1954 (MODEL 14.19). */
#include "effects/effect.h"

#include "propagation/attenuation.h"

static const double *begin(const struct effect_scan *scan)
{
    double rate_mmph = scan->frame->conditions.snow_mmph;
    return effect_constant(scan, attenuation_snow_dbpkm(scan->sensor->carrier_hz, rate_mmph));
}

const struct effect effect_snow = {
    .summary = "snow attenuates echoes",
    .cause = "snow_mmph of the conditions",
    .left_out_when = "snow_mmph is 0",
    .cost = "an exponential per echo",
    .home = EFFECT_HOME_SENSOR,
    .members = {{EFFECT_CONDITION(snow_mmph), {8, 0.15, EFFECT_BY_LOGARITHM, 0.1, 10}}},
    .begin = begin,
    .receive = effect_attenuate,
};
