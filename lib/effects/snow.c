#include "effects/effect.h"

#include "base/elementary.h"
#include "base/units.h"

/* Gunn and East (1954): scattering by flakes smaller than the wave, and absorption (MODEL 14.19).
 */
static const double *begin(const struct effect_scan *scan)
{
    double rate_mmph = scan->frame->conditions.snow_mmph;
    double wave_cm = 100 * units_wavelength_m(scan->sensor->carrier_hz);
    double square = wave_cm * wave_cm;
    return effect_constant(scan, 0.00349 * elementary_pow(rate_mmph, 1.6) / (square * square) +
                                     0.00224 * rate_mmph / wave_cm);
}

const struct effect effect_snow = {
    .summary = "snow attenuates echoes",
    .cause = "snow_mmph of the conditions",
    .left_out_when = "snow_mmph is 0",
    .cost = "an exponential per echo",
    .home = EFFECT_HOME_SENSOR,
    .members = {{EFFECT_CONDITION(snow_mmph)}},
    .begin = begin,
    .receive = effect_attenuate,
};
