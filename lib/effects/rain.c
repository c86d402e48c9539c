/* Attenuation by rain by ITU-R P.838-3 (MODEL 14.15). */
#include "effects/effect.h"

#include "propagation/attenuation.h"

static const double *begin(const struct effect_scan *scan)
{
    const struct sensor *sensor = scan->sensor;
    struct attenuation_law law = attenuation_rain_law(sensor->carrier_hz, sensor->polarization);
    return effect_constant(scan, attenuation_rain_dbpkm(law, scan->frame->conditions.rain_mmph));
}

const struct effect effect_rain = {
    .summary = "rain attenuates echoes",
    .cause = "rain_mmph of the conditions",
    .left_out_when = "rain_mmph is 0",
    .cost = "an exponential per echo",
    .home = EFFECT_HOME_SENSOR,
    .members = {{EFFECT_CONDITION(rain_mmph), {1, 0.4, EFFECT_BY_LOGARITHM, 0.05, 100}}},
    .begin = begin,
    .receive = effect_attenuate,
};
