/* Simulated by ideal/direct_echoes.c (MODEL 2.3). */
#include "effects/effect.h"

const struct effect effect_plane_reflection = {
    .summary = "a flat side mirrors the radar's wave back from the foot of the perpendicular",
    .cause = "planes of a vehicle",
    .left_out_when = "no object has planes",
    .cost = "a perpendicular per plane",
    .scene = "{object} has flat sides",
    .home = EFFECT_HOME_IDEAL,
    .of_paper = true,
};
