#include "wheel.h"

#include <math.h>

#include "elementary.h"
#include "poisson.h"
#include "random.h"
#include "units.h"

int64_t wheel_count(double uniform)
{
    return poisson_count(WHEEL_MEAN_COUNT, uniform);
}

int64_t wheel_most_count(void)
{
    return poisson_count(WHEEL_MEAN_COUNT, RANDOM_MOST);
}

struct wheel_point wheel_point(const double uniform[2])
{
    return (struct wheel_point){0.3 + 0.7 * uniform[0], 2 * PI * uniform[1]};
}

double wheel_range_rate_mps(double hub_mps, double rolling_mps, struct wheel_point point)
{
    return hub_mps + rolling_mps * (point.fraction * elementary_cos(point.angle_rad));
}

struct bounds wheel_bounds_mps(double hub_mps, double rolling_mps)
{
    return (struct bounds){hub_mps - fabs(rolling_mps), hub_mps + fabs(rolling_mps)};
}
