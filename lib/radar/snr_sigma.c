#include "radar/snr_sigma.h"

#include <math.h>

#include "base/elementary.h"

double snr_sigma_of(const struct snr_sigma *accuracy, double snr)
{
    double noise = accuracy->factor * accuracy->cell / sqrt(snr);
    /* The lesser passes over the NaN of 0/0. */
    double variance = elementary_min(noise * noise + accuracy->floor * accuracy->floor,
                                     accuracy->cell * accuracy->cell / 12);
    return sqrt(variance + accuracy->step * accuracy->step / 12);
}
