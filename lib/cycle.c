#include "cycle.h"

#include <math.h>

/* The number of the latest instant at or before time_s; -1 before the first. */
static double latest_instant(double cycle_s, double time_s)
{
    return fmax(floor(time_s / cycle_s + 1e-9), -1);
}

enum cycle_answer cycle_instant_s(double cycle_s, double time_s, double interval_s,
                                  double *instant_s)
{
    if (cycle_s == 0) {
        *instant_s = time_s;
        return CYCLE_ONE;
    }
    double latest = latest_instant(cycle_s, time_s);
    double fresh = latest - latest_instant(cycle_s, time_s - interval_s);
    if (fresh > 1)
        return CYCLE_SEVERAL;
    if (fresh < 1)
        return CYCLE_NONE;
    *instant_s = latest * cycle_s;
    return CYCLE_ONE;
}
