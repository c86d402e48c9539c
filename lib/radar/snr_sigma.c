#include "radar/snr_sigma.h"

#include "base/elementary.h"

double snr_sigma_of(const struct snr_sigma *quantity, double snr)
{
    double noise = quantity->factor * quantity->cell / sqrt(snr);
    /* elementary_min ignores the NaN of 0/0. */
    double variance = elementary_min(noise * noise + quantity->floor * quantity->floor,
                                     quantity->cell * quantity->cell / 12);
    return sqrt(variance + quantity->step * quantity->step / 12);
}
