/* Simulated by noise/target_list.c. */
#include "effects/effect.h"

static bool described(const struct effect_scan *scan)
{
    return scan->sensor->list_limit > 0;
}

const struct effect effect_list_limit = {
    .summary = "the sensor reports no more targets than its list holds",
    .home = EFFECT_HOME_NOISE,
    .cause = "list_limit of a sensor",
    .bound = "the list is shorter",
    .cost = "nothing",
    .described = described,
};
