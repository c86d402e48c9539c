/* Simulated by noise/noise_targets.c. */
#include "effects/effect.h"

static bool described(const struct effect_scan *scan)
{
    return scan->sensor->false_alarms > 0;
}

const struct effect effect_false_alarms = {
    .summary = "noise alone passes the threshold where there is nothing",
    .home = EFFECT_HOME_NOISE,
    .cause = "false_alarms of a sensor",
    .bound = "false_alarms is 0",
    .cost = "four draws per false alarm",
    .described = described,
};
