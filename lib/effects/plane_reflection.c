/* Simulated by ideal/direct_echoes.c. */
#include "effects/effect.h"

const struct effect effect_plane_reflection = {
    .summary = "a flat side mirrors the radar from the foot of the perpendicular",
    .home = EFFECT_HOME_IDEAL,
    .cause = "planes of a vehicle",
    .bound = "no object has planes",
    .cost = "a foot per plane",
};
