/* Simulated by stages/noise.c (MODEL 8). */
#include "effects/effect.h"

const struct effect effect_final_threshold = {
    .summary = "a cell whose noisy amplitude is below the threshold is lost",
    .cause = "final_threshold of a sensor",
    .left_out_when = "the sensor's final_threshold is false",
    .cost = "a comparison per cell",
    .scene = "{object} is too weak after noise",
    .home = EFFECT_HOME_NOISE,
    .of_paper = true,
    .members = {{EFFECT_SENSOR(final_threshold)}},
};
