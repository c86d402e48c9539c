/* Simulated by ideal/roadside_echoes.c (MODEL 14.23). */
#include "effects/effect.h"

const struct effect effect_roadside = {
    .summary = "rails, poles, kerbs and vegetation beside the road make echoes that stay in place",
    .cause = "roadside of a scene",
    .left_out_when = "no cell of a strip is in the sensor's range and view",
    .cost = "a draw per cell in view, and a sight line per scatterer",
    .home = EFFECT_HOME_IDEAL,
    .members = {{EFFECT_FRAME(roadside)}},
    .purposes = {RANDOM_ROADSIDE, RANDOM_ROADSIDE_LEVEL},
};
