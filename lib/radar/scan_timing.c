#include "radar/scan_timing.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

#include "base/units.h"

double scan_timing_dwell_s(double carrier_hz, double cell_mps)
{
    return units_wavelength_m(carrier_hz) / (2 * cell_mps);
}

/* The number of the latest instant at or before time_s; that at time 0 has the number 0. */
static double latest_instant(double cycle_s, double time_s)
{
    double cycles = time_s / cycle_s;
    return floor(cycles + 1e-9 + 4 * DBL_EPSILON * fabs(cycles));
}

/* The nearest decimal, as cycles and so their multiples are decimals: 4.392, not
 * 4.3919999999999995. */
static double decimal(double time_s)
{
    return fabs(time_s) < 1e6 ? round(time_s * 1e9) / 1e9 : time_s;
}

enum scan_timing_answer scan_timing_instant_s(double cycle_s, double time_s, double interval_s,
                                              double *instant_s)
{
    double slack_s = 1e-9 * cycle_s + 4 * DBL_EPSILON * fabs(time_s);
    bool long_frame = interval_s > cycle_s + slack_s;
    if (cycle_s == 0 || long_frame) {
        *instant_s = time_s;
        return cycle_s == 0 ? SCAN_TIMING_ONE : SCAN_TIMING_LONG_FRAME;
    }
    double latest = latest_instant(cycle_s, time_s);
    if (latest == latest_instant(cycle_s, time_s - interval_s))
        return SCAN_TIMING_NONE;
    bool at_the_frame = fabs(latest * cycle_s - time_s) <= slack_s;
    *instant_s = at_the_frame ? time_s : decimal(latest * cycle_s);
    return SCAN_TIMING_ONE;
}
