/* Simulated by ideal/line_of_sight.c (MODEL 2.5). */
#include "effects/effect.h"

const struct effect effect_occlusion = {
    .summary = "an object hides what lies behind it",
    .cause = "blocks of a vehicle",
    .left_out_when = "no object stands between the sensor and another object",
    .cost = "a test per reflector and object in the way",
    .scene = "{by} hides {object}",
    .home = EFFECT_HOME_IDEAL,
    .of_paper = true,
};
