/* Attenuation by rain, fog and snow (MODEL 14.15, 14.19).
 *
 * The attenuation gamma, in dB/km, is one way. The law of rain, ITU-R P.838-3, holds for 1 to 1000
 * GHz, the law of fog, P.840 with the double-Debye permittivity of water, up to 200 GHz. */
#pragma once

#include "propagation/carrier.h"

/* The law of rain for one carrier frequency and polarization. */
struct attenuation_law {
    double k, alpha;
};

/* carrier_hz is in [1e9, 1e12]. */
struct attenuation_law attenuation_rain_law(double carrier_hz, enum polarization polarization);

/* gamma of rain; rate_mmph >= 0. Exactly 0 without rain. */
double attenuation_rain_dbpkm(struct attenuation_law law, double rate_mmph);

/* gamma of fog. carrier_hz is in [1e9, 2e11], the temperature of the water in [-10, 50] deg C,
 * water_gpm3 >= 0; dense fog has 0.5 g/m^3. */
double attenuation_fog_dbpkm(double carrier_hz, double temperature_c, double water_gpm3);

/* gamma of dry snow; rate_mmph >= 0, as liquid water. For waves of 0.9 to 10 cm; shorter ones
 * extrapolate. */
double attenuation_snow_dbpkm(double carrier_hz, double rate_mmph);

/* The factor on an echo's amplitude, there and back: 10^(-2 gamma R/(1000 · 20)). Exactly 1 for an
 * attenuation of 0. */
double attenuation_amplitude_factor(double attenuation_dbpkm, double range_m);
