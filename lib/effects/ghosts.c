/* Simulated by ideal/ghost_echoes.c (MODEL 14.1). */
#include "effects/effect.h"

static bool is_own(const struct echo_id *part)
{
    return part->mirror != NULL;
}

const struct effect effect_ghosts = {
    .summary = "walls, guardrails and sides of vehicles mirror what stands before them",
    .cause = "bounces of a sensor, mirrors of a vehicle",
    .left_out_when =
        "the sensor's bounces are less than 2, or no mirror in its range faces both the sensor and "
        "another object, or neither the object nor its mirror image is in the sensor's view",
    .cost = "a mirror image per reflector and mirror",
    .scene = "{mirror} mirrors {object}",
    .is_own = is_own,
    .home = EFFECT_HOME_IDEAL,
    .members = {{EFFECT_SENSOR(bounces)}},
};
