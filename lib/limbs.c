#include "limbs.h"

#include <math.h>

#include "poisson.h"
#include "random.h"

#define SLOWEST (-1.0)
#define FASTEST 1.5

int64_t limbs_count(double uniform)
{
    return poisson_count(LIMBS_MEAN_COUNT, uniform);
}

int64_t limbs_most_count(void)
{
    return poisson_count(LIMBS_MEAN_COUNT, RANDOM_MOST);
}

/* The triangular law by inversion, from the end that the draw is near. */
static double swing(double uniform)
{
    double width = FASTEST - SLOWEST;
    if (uniform * width < -SLOWEST)
        return SLOWEST + sqrt(uniform * width * -SLOWEST);
    return FASTEST - sqrt((1 - uniform) * width * FASTEST);
}

struct limb limbs_limb(const double uniform[2])
{
    return (struct limb){swing(uniform[0]), LIMBS_REACH_M * (2 * uniform[1] - 1)};
}

double limbs_range_rate_mps(double torso_mps, double walking_mps, struct limb limb)
{
    return torso_mps + walking_mps * limb.swing;
}

struct bounds limbs_bounds_mps(double torso_mps, double walking_mps)
{
    double slow = torso_mps + SLOWEST * walking_mps, fast = torso_mps + FASTEST * walking_mps;
    return (struct bounds){fmin(slow, fast), fmax(slow, fast)};
}
