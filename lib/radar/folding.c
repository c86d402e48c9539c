#include "radar/folding.h"

#include <math.h>

double folding_range_rate_mps(double range_rate_mps, double middle_mps, double unambiguous_mps)
{
    double off_mps = range_rate_mps - middle_mps;
    if (off_mps >= -unambiguous_mps && off_mps < unambiguous_mps)
        return range_rate_mps;
    double folded = remainder(off_mps, 2 * unambiguous_mps);
    return middle_mps + (folded == unambiguous_mps ? -unambiguous_mps : folded);
}

double folding_range_m(double range_m, double unambiguous_m)
{
    return fmod(range_m, unambiguous_m);
}
