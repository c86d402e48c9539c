#include "limbs.h"

#include <math.h>

#include "poisson.h"

#define SLOWEST (-1.0)
#define FASTEST 1.5

int64_t limbs_count(double uniform)
{
    return poisson_count(LIMBS_MEAN_COUNT, uniform);
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
