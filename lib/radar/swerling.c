#include "radar/swerling.h"

#include "base/elementary.h"
#include "base/random.h"
#include "base/units.h"

#define LN_10 2.30258509299404568402

/* A standard Gaussian number by Box and Muller, cut at 3 from above. */
static double cut_gaussian(const double uniform[4])
{
    double radius = sqrt(-2 * elementary_log(uniform[0]));
    return elementary_min(radius * elementary_sincos_turns(uniform[1]).cos, 3);
}

static double log_normal(double sigma_db, double gaussian)
{
    double mean_db = -LN_10 / 20 * sigma_db * sigma_db;
    return units_amplitude_from_db(mean_db + sigma_db * gaussian);
}

double swerling_amplitude_factor(enum fluctuation_law law, double sigma_db, const double uniform[4])
{
    switch (law) {
    case FLUCTUATION_SWERLING_1:
        return sqrt(-elementary_log(uniform[0]));
    case FLUCTUATION_SWERLING_3:
        return sqrt(-(elementary_log(uniform[0]) + elementary_log(uniform[1])) / 2);
    case FLUCTUATION_LOG_NORMAL:
        return log_normal(sigma_db, cut_gaussian(uniform));
    case FLUCTUATION_NONE:
        break;
    }
    return 1;
}
