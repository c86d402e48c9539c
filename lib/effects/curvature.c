/* Simulated by ideal/look.c (MODEL 14.5). */
#include "effects/effect.h"

const struct effect effect_curvature = {
    .summary = "a curved side has a larger cross section from farther away",
    .cause = "curved_sides of a sensor, profile_radius_m of a plane",
    .left_out_when =
        "the sensor's curved_sides is false or no plane in sight has a profile_radius_m",
    .cost = "a square root per plane",
    .scene = "{object} has curved sides",
    .home = EFFECT_HOME_IDEAL,
    .members = {{EFFECT_SENSOR(curved_sides)}},
};
