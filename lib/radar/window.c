#include "window.h"

#include <math.h>

#include "elementary.h"
#include "units.h"

double window_hann(double bins)
{
    double d = fabs(bins);
    if (d == 0)
        return 1;
    if (d == 1)
        return 0.5;
    return elementary_sincos_turns(d / 2).sin / (PI * d * ((1 - d) * (1 + d)));
}

double window_hann_offset(double before, double peak, double after)
{
    double ratio = elementary_max(before, after) / peak;
    double bins = elementary_max((2 * ratio - 1) / (ratio + 1), 0);
    return before > after ? -bins : before < after ? bins : 0;
}
