/* What rain and fog take from a wave, and what rain sends back (EFFECTS 13).
 *
 * Rain attenuates by gamma = k R^alpha dB/km for a rate of R mm/h, with k and alpha of ITU-R
 * P.838-3 (1 to 1000 GHz); fog by K_l dB/km per g/m^3 of water, droplets far smaller than the
 * wavelength and water by the double-Debye permittivity of ITU-R P.840 (up to 200 GHz). */
#ifndef ATTENUATION_H
#define ATTENUATION_H

#include "radar/carrier.h"

struct attenuation_law {
    double k, alpha;
};

/* Constant for a sensor. carrier_hz from 1e9 to 1e12. */
struct attenuation_law attenuation_rain_law(double carrier_hz, enum polarization polarization);

/* One way; rate >= 0, and 0 without rain. */
double attenuation_rain_dbpkm(struct attenuation_law law, double rate_mmph);

/* One way; liquid water, from -10 to 50 deg C; water >= 0 (dense fog has 0.5 g/m^3). */
double attenuation_fog_dbpkm(double carrier_hz, double temperature_c, double water_gpm3);

/* There and back through both together: 10^(-2 gamma R/(1000 · 20)). Exactly 1 without either. */
double attenuation_amplitude_factor(double attenuation_dbpkm, double range_m);

#endif
