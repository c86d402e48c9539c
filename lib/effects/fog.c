/* Attenuation by fog by ITU-R P.840 (MODEL 14.15), at 10 degrees Celsius. */
#include "effects/effect.h"

#include "propagation/attenuation.h"

static const double *begin(const struct effect_scan *scan)
{
    const double temperature_c = 10;
    return effect_constant(scan, attenuation_fog_dbpkm(scan->sensor->carrier_hz, temperature_c,
                                                       scan->frame->conditions.fog_gpm3));
}

const struct effect effect_fog = {
    .summary = "fog attenuates echoes",
    .cause = "fog_gpm3 of the conditions",
    .left_out_when = "fog_gpm3 is 0",
    .cost = "an exponential per echo",
    .home = EFFECT_HOME_SENSOR,
    .members = {{EFFECT_CONDITION(fog_gpm3), {2, 0.15, EFFECT_BY_LOGARITHM, 0.005, 1}}},
    .begin = begin,
    .receive = effect_attenuate,
};
