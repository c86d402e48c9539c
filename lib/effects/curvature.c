/* Simulated by ideal/look.c. */
#include "effects/effect.h"

const struct effect effect_curvature = {
    .summary = "a curved side reflects more from farther away",
    .home = EFFECT_HOME_IDEAL,
    .cause = "curved_sides of a sensor, profile_radius_m of a plane",
    .bound = "no plane has a radius",
    .cost = "a square root per plane",
};
