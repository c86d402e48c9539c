#include "radar/folding.h"

#include <math.h>

double folding_range_rate_mps(double range_rate_mps, double unambiguous_mps)
{
    double folded = remainder(range_rate_mps, 2 * unambiguous_mps);
    return folded == unambiguous_mps ? -unambiguous_mps : folded;
}

double folding_range_m(double range_m, double unambiguous_m)
{
    return fmod(range_m, unambiguous_m);
}
