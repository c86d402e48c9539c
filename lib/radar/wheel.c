#include "wheel.h"

#include "elementary.h"
#include "poisson.h"
#include "units.h"

int64_t wheel_count(double uniform)
{
    return poisson_count(WHEEL_MEAN_COUNT, uniform);
}

struct wheel_point wheel_point(const double uniform[2])
{
    return (struct wheel_point){0.3 + 0.7 * uniform[0], 2 * PI * uniform[1]};
}

double wheel_range_rate_mps(double hub_mps, double rolling_mps, struct wheel_point point)
{
    return hub_mps + rolling_mps * (point.fraction * elementary_cos(point.angle_rad));
}
