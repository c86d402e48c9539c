#include "radar/interferer.h"

#include <assert.h>

#include "base/elementary.h"
#include "base/units.h"

#define BOLTZMANN_JPK 1.380649e-23
#define REFERENCE_K 290

double interferer_noise_dbm(double bandwidth_hz, double noise_figure_db)
{
    assert(bandwidth_hz > 0);
    double milliwatts = 1e3 * BOLTZMANN_JPK * REFERENCE_K * bandwidth_hz;
    return 10 * elementary_log10(milliwatts) + noise_figure_db;
}

double interferer_power_dbm(double eirp_dbm, double gain_db, double wavelength_m, double range_m)
{
    assert(wavelength_m > 0 && range_m > 0);
    return eirp_dbm + gain_db + units_amplitude_db(wavelength_m / (4 * PI * range_m));
}

double interferer_overlap(double band_hz, double slope_difference_hzps, double chirp_s)
{
    assert(band_hz > 0 && chirp_s > 0);
    return elementary_min(band_hz / (fabs(slope_difference_hzps) * chirp_s), 1);
}

double interferer_ratio(double power_dbm, double noise_dbm, double overlap, double hit_share)
{
    return elementary_pow(10, (power_dbm - noise_dbm) / 10) * overlap * hit_share;
}

double interferer_noise_factor(double ratio)
{
    return sqrt(1 + ratio);
}

double interferer_threshold(double threshold, double ratio)
{
    return threshold * interferer_noise_factor(ratio);
}
