/* Simulated by ideal: stages/ideal.c takes the scan so much earlier (ideal/look.h). */
#include "effects/effect.h"

const struct effect effect_latency = {
    .summary = "the scan shows the world as it was a moment ago",
    .home = EFFECT_HOME_IDEAL,
    .cause = "latency_s of a sensor",
    .bound = "there is no latency",
    .cost = "a step back per object",
};
