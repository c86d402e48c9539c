#include "propagation/micro_doppler.h"

#include "base/elementary.h"
#include "base/units.h"

/* Ends of the triangular law of x. */
#define SLOWEST (-1.0)
#define FASTEST 1.5

double micro_doppler_share(double ground_mps)
{
    double over_mps = fabs(ground_mps) - MICRO_DOPPLER_STILL_MPS;
    double share = over_mps / (MICRO_DOPPLER_FULL_MPS - MICRO_DOPPLER_STILL_MPS);
    return elementary_min(elementary_max(share, 0), 1);
}

struct wheel_point micro_doppler_wheel_point(const double uniform[2])
{
    return (struct wheel_point){0.3 + 0.7 * uniform[0], 2 * PI * uniform[1]};
}

double micro_doppler_wheel_rate_mps(double hub_mps, double rolling_mps, struct wheel_point point)
{
    return hub_mps + rolling_mps * (point.fraction * elementary_cos(point.angle_rad));
}

/* x, by inversion of its triangular law, from the end that is nearer, so that nothing cancels. */
static double swing(double uniform)
{
    double width = FASTEST - SLOWEST;
    if (uniform * width < -SLOWEST)
        return SLOWEST + sqrt(uniform * width * -SLOWEST);
    return FASTEST - sqrt((1 - uniform) * width * FASTEST);
}

struct limb micro_doppler_limb(const double uniform[2])
{
    return (struct limb){swing(uniform[0]), MICRO_DOPPLER_LIMB_REACH_M * (2 * uniform[1] - 1)};
}

double micro_doppler_limb_rate_mps(double torso_mps, double walking_mps, struct limb limb)
{
    return torso_mps + walking_mps * limb.swing;
}
