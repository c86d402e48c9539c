/* Simulated by ideal/line_of_sight.c. */
#include "effects/effect.h"

const struct effect effect_occlusion = {
    .summary = "an object hides what lies behind it",
    .home = EFFECT_HOME_IDEAL,
    .cause = "blocks of a vehicle",
    .bound = "no object stands in another one's sector",
    .cost = "a sight line per reflector and object in the way",
};
