/* Simulated by noise/target_list.c (MODEL 10). */
#include "effects/effect.h"

static bool described(const struct effect_scan *scan)
{
    return scan->sensor->list_limit > 0;
}

const struct effect effect_list_limit = {
    .summary = "the sensor reports no more targets than its list holds",
    .cause = "list_limit of a sensor",
    .left_out_when = "the sensor's list_limit is 0",
    .cost = "nothing",
    .home = EFFECT_HOME_NOISE,
    .described = described,
};
