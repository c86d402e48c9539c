#include "propagation/attenuation.h"

#include <assert.h>

#include "base/elementary.h"
#include "base/units.h"

/* A curve over the logarithm of the frequency in GHz: a sum of Gaussian bells and a line. */
struct curve {
    struct {
        double height, centre, width;
    } bells[5];
    double slope, offset;
};

/* ITU-R P.838-3, tables 1 and 2: lg k. */
static const struct curve lg_k_curves[] = {
    [POLARIZATION_HORIZONTAL] = {{{-5.33980, -0.10008, 1.13098},
                                  {-0.35351, 1.26970, 0.45400},
                                  {-0.23789, 0.86036, 0.15354},
                                  {-0.94158, 0.64552, 0.16817},
                                  {0, 0, 1}},
                                 -0.18961,
                                 0.71147},
    [POLARIZATION_VERTICAL] = {{{-3.80595, 0.56934, 0.81061},
                                {-3.44965, -0.22911, 0.51059},
                                {-0.39902, 0.73042, 0.11899},
                                {0.50167, 1.07319, 0.27195},
                                {0, 0, 1}},
                               -0.16398,
                               0.63297},
};

/* ITU-R P.838-3, tables 3 and 4: alpha. */
static const struct curve alpha_curves[] = {
    [POLARIZATION_HORIZONTAL] = {{{-0.14318, 1.82442, -0.55187},
                                  {0.29591, 0.77564, 0.19822},
                                  {0.32177, 0.63773, 0.13164},
                                  {-5.37610, -0.96230, 1.47828},
                                  {16.1721, -3.29980, 3.43990}},
                                 0.67849,
                                 -1.95537},
    [POLARIZATION_VERTICAL] = {{{-0.07771, 2.33840, -0.76284},
                                {0.56727, 0.95545, 0.54039},
                                {-0.20238, 1.14520, 0.26809},
                                {-48.2991, 0.791669, 0.116226},
                                {48.5833, 0.791459, 0.116479}},
                               -0.053739,
                               0.83433},
};

static double curve_at(const struct curve *curve, double lg_ghz)
{
    double sum = curve->slope * lg_ghz + curve->offset;
    for (int i = 0; i < 5; i++) {
        double widths = (lg_ghz - curve->bells[i].centre) / curve->bells[i].width;
        sum += curve->bells[i].height * elementary_exp(-widths * widths);
    }
    return sum;
}

struct attenuation_law attenuation_rain_law(double carrier_hz, enum polarization polarization)
{
    assert(carrier_hz >= 1e9 && carrier_hz <= 1e12);
    double lg_ghz = elementary_log10(carrier_hz / 1e9);
    return (struct attenuation_law){
        elementary_pow(10, curve_at(&lg_k_curves[polarization], lg_ghz)),
        curve_at(&alpha_curves[polarization], lg_ghz)};
}

double attenuation_rain_dbpkm(struct attenuation_law law, double rate_mmph)
{
    assert(rate_mmph >= 0);
    return law.k * elementary_pow(rate_mmph, law.alpha);
}

/* The names are those of ITU-R P.840. */
double attenuation_fog_dbpkm(double carrier_hz, double temperature_c, double water_gpm3)
{
    assert(water_gpm3 >= 0);
    double ghz = carrier_hz / 1e9;
    double theta_less_1 = 300 / (273.15 + temperature_c) - 1;
    double epsilon_0 = 77.66 + 103.3 * theta_less_1, epsilon_1 = 0.0671 * epsilon_0;
    double epsilon_2 = 3.52;
    double primary_ghz = 20.20 - 146 * theta_less_1 + 316 * theta_less_1 * theta_less_1;
    double primary = ghz / primary_ghz, secondary = primary / 39.8;
    double primary_part = (epsilon_0 - epsilon_1) / (1 + primary * primary);
    double secondary_part = (epsilon_1 - epsilon_2) / (1 + secondary * secondary);
    double permittivity = primary_part + secondary_part + epsilon_2;
    double loss = primary * primary_part + secondary * secondary_part;
    double eta = (2 + permittivity) / loss;
    return 0.819 * ghz / (loss * (1 + eta * eta)) * water_gpm3;
}

/* Scattering by flakes smaller than the wave, and absorption (Gunn and East 1954). */
double attenuation_snow_dbpkm(double carrier_hz, double rate_mmph)
{
    assert(rate_mmph >= 0);
    double wave_cm = 100 * units_wavelength_m(carrier_hz), square = wave_cm * wave_cm;
    double scattered = 0.00349 * elementary_pow(rate_mmph, 1.6) / (square * square);
    return scattered + 0.00224 * rate_mmph / wave_cm;
}

double attenuation_amplitude_factor(double attenuation_dbpkm, double range_m)
{
    return units_amplitude_from_db(-2 * attenuation_dbpkm * range_m / 1000);
}
