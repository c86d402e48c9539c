/* Simulated by stages/sensor.c and the stages that stand in for it (MODEL 6). */
#include "effects/effect.h"

const struct effect effect_threshold = {
    .summary = "a cell whose summed amplitude is below the first threshold is lost",
    .cause = "threshold_db and first_threshold of a sensor",
    .cost = "a comparison per cell",
    .scene = "{object} is too weak",
    .home = EFFECT_HOME_SENSOR,
    .of_paper = true,
};
