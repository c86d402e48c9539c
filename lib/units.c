#include "units.h"

#include <math.h>

double units_amplitude_db(double amplitude)
{
    return 20 * log10(amplitude);
}

double units_amplitude_from_db(double db)
{
    return pow(10, db / 20);
}

double units_wrap_rad(double angle_rad)
{
    double wrapped = remainder(angle_rad, 2 * PI);
    return wrapped <= -PI ? PI : wrapped;
}

double units_si(double x)
{
    return x == 0 ? 1 : sin(x) / x;
}
