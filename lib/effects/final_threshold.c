/* Simulated by stages/noise.c. */
#include "effects/effect.h"

static bool described(const struct effect_scan *scan)
{
    return scan->sensor->final_threshold;
}

const struct effect effect_final_threshold = {
    .summary = "the noisy amplitude must pass the threshold once more",
    .home = EFFECT_HOME_NOISE,
    .cause = "final_threshold of a sensor",
    .bound = "there is none",
    .cost = "a comparison per cell",
    .described = described,
};
