/* Simulated by ideal/ghost_echoes.c. */
#include "effects/effect.h"

const struct effect effect_ghosts = {
    .summary = "walls, guardrails and flat sides mirror what stands before them",
    .home = EFFECT_HOME_IDEAL,
    .cause = "bounces of a sensor, mirrors of a vehicle",
    .bound = "for every object and mirror that cannot face it and the sensor",
    .cost = "a mirror image per reflector and mirror in reach",
};
