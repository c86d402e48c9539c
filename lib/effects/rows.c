/* Simulated by ideal/direct_echoes.c. */
#include "effects/effect.h"

const struct effect effect_rows = {
    .summary = "posts along a line, made only within range",
    .home = EFFECT_HOME_IDEAL,
    .cause = "rows of a vehicle",
    .bound = "no object has rows",
    .cost = "the posts in range",
};
