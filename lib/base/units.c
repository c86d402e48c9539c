#include "base/units.h"

#include "base/elementary.h"

double units_amplitude_db(double amplitude)
{
    return 20 * elementary_log10(amplitude);
}

double units_shortfall_db(double threshold, double amplitude)
{
    double db = units_amplitude_db(threshold) - units_amplitude_db(amplitude);
    return elementary_min(elementary_max(db, 0), 1e4);
}

double units_amplitude_from_db(double db)
{
    return elementary_pow(10, db / 20);
}

double units_wavelength_m(double carrier_hz)
{
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
