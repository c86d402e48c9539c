/* Simulated by ideal/line_of_sight.c (MODEL 14.4). */
#include "effects/effect.h"

const struct effect effect_diffraction = {
    .summary = "the shadow of an object has soft edges",
    .cause = "diffraction of a sensor",
    .left_out_when = "the sensor's diffraction is false or no object stands within a Fresnel "
                     "radius of a sight line",
    .cost = "four edges per sight line and object near it",
    .scene = "{object} is seen around an edge",
    .home = EFFECT_HOME_IDEAL,
    .members = {{EFFECT_SENSOR(diffraction)}},
};
