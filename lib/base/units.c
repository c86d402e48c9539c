#include "base/units.h"

#include <assert.h>

#include "base/elementary.h"

/* Doubles from here on are whole, and infinity is among them: there is nothing to round. */
#define WHOLE_STEPS 0x1p52

double units_amplitude_db(double amplitude)
{
    assert(amplitude >= 0);
    return 20 * elementary_log10(amplitude);
}

double units_shortfall_db(double threshold, double amplitude)
{
    assert(threshold > 0 && amplitude >= 0);
    double db = units_amplitude_db(threshold) - units_amplitude_db(amplitude);
    return elementary_min(elementary_max(db, 0), 1e4);
}

double units_amplitude_from_db(double db)
{
    return elementary_pow(10, db / 20);
}

double units_amplitude_logarithm(double db)
{
    return 2.30258509299404568402 / 20 * db;
}

double units_wavelength_m(double carrier_hz)
{
    assert(carrier_hz > 0);
    return SPEED_OF_LIGHT_MPS / carrier_hz;
}

double units_wrap_rad(double angle_rad)
{
    double wrapped = elementary_wrap(angle_rad);
    return wrapped <= -PI ? PI : wrapped;
}

double units_si(double x)
{
    return x == 0 ? 1 : elementary_sin(x) / x;
}

double units_rounded(double value, double step)
{
    double steps = step > 0 ? value / step : (double)INFINITY;
    return fabs(steps) < WHOLE_STEPS ? step * round(steps) : value;
}
