#include "ambiguity.h"

#include <math.h>

#include "units.h"

double ambiguity_unambiguous_mps(double wavelength_m, double repetition_s)
{
    return wavelength_m / (4 * repetition_s);
}

double ambiguity_unambiguous_m(double repetition_hz)
{
    return SPEED_OF_LIGHT_MPS / (2 * repetition_hz);
}

double ambiguity_range_rate_mps(double range_rate_mps, double unambiguous_mps)
{
    double folded = remainder(range_rate_mps, 2 * unambiguous_mps);
    return folded == unambiguous_mps ? -unambiguous_mps : folded;
}

double ambiguity_range_m(double range_m, double unambiguous_m)
{
    return fmod(range_m, unambiguous_m);
}
