/* Simulated by ideal/line_of_sight.c. */
#include "effects/effect.h"

const struct effect effect_diffraction = {
    .summary = "the shadows of occlusion have soft edges",
    .home = EFFECT_HOME_IDEAL,
    .cause = "diffraction of a sensor",
    .bound = "for every object whose edges stay a Fresnel radius clear of the sector",
    .cost = "four edges per sight line and object near it",
};
