#include "radar/measurement_sigma.h"

#include "base/elementary.h"

double measurement_sigma_at_snr(const struct measurement_sigma *quantity, double snr)
{
    double noise = quantity->factor * quantity->cell / sqrt(snr);
    /* elementary_min ignores the NaN of 0/0. */
    return sqrt(elementary_min(noise * noise + quantity->sigma * quantity->sigma,
                               quantity->cell * quantity->cell / 12));
}

double measurement_sigma_at(const struct measurement_sigma *quantity, double amplitude)
{
    double ratio = amplitude / quantity->noise;
    if (quantity->law == SIGMA_BY_SNR)
        return measurement_sigma_at_snr(quantity, ratio * ratio);
    if (quantity->law == SIGMA_BY_AMPLITUDE)
        return elementary_min(quantity->threshold / amplitude, 1) * quantity->sigma;
    return quantity->sigma;
}
