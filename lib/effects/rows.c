/* Simulated by ideal/direct_echoes.c (MODEL 2.6). */
#include "effects/effect.h"

const struct effect effect_rows = {
    .summary = "every post of a row within range has an echo",
    .cause = "rows of a vehicle",
    .left_out_when = "no object has rows",
    .cost = "what points cost, for every post in range",
    .home = EFFECT_HOME_IDEAL,
    .of_paper = true,
};
