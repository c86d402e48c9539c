/* Simulated by ideal/look.c (MODEL 2.2). */
#include "effects/effect.h"

const struct effect effect_visibility = {
    .summary = "a point or post is seen from a range of angles around its facing",
    .cause = "full_rad and zero_rad of a point or row",
    .left_out_when = "no object has points or rows",
    .cost = "an arctangent per point and post",
    .scene = "{object} turns points away",
    .home = EFFECT_HOME_IDEAL,
    .of_paper = true,
};
