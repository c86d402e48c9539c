/* Simulated by noise/target_list.c (MODEL 10). */
#include "effects/effect.h"

const struct effect effect_list_limit = {
    .summary = "the sensor reports no more targets than its list holds",
    .cause = "list_limit of a sensor",
    .left_out_when = "the sensor's list_limit is 0",
    .cost = "nothing",
    .scene = "{object} comes behind the limit",
    .home = EFFECT_HOME_NOISE,
    .of_paper = true,
    .members = {{EFFECT_SENSOR(list_limit)}},
};
