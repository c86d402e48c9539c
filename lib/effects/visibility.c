/* Simulated by ideal/look.c. */
#include "effects/effect.h"

const struct effect effect_visibility = {
    .summary = "a reflector is seen from a range of angles around its facing",
    .home = EFFECT_HOME_IDEAL,
    .cause = "full_rad, zero_rad of a point or row",
    .bound = "no object has points or rows",
    .cost = "an arctangent per reflector",
};
