#include "accuracy.h"

#include <math.h>

#include "elementary.h"
#include "units.h"

double accuracy_sigma(const struct accuracy *accuracy, double snr)
{
    double noise = accuracy->factor * accuracy->cell / sqrt(snr);
    /* fmin passes over the NaN of 0/0. */
    double variance = fmin(noise * noise + accuracy->floor * accuracy->floor,
                           accuracy->cell * accuracy->cell / 12);
    return sqrt(variance + accuracy->step * accuracy->step / 12);
}

/* With c and s the cosine and the size of the sine, cos((pi/2) s) = sin w, w = (pi/2) c^2 / (1 +
 * s): then (2/pi) sin w / c is si(w) c / (1 + s). */
double accuracy_dipole_pair_rad(double azimuth_rad, double snr)
{
    struct elementary_sincos azimuth = elementary_sincos(azimuth_rad);
    double part = fabs(azimuth.cos) / (1 + fabs(azimuth.sin));
    double sigma_rad = units_si(PI / 2 * part * fabs(azimuth.cos)) * part / sqrt(2 * snr);
    return fmin(sigma_rad, PI / sqrt(12));
}
