/* Simulated by ideal/look.c. */
#include "effects/effect.h"

const struct effect effect_elevation = {
    .summary = "what is higher or lower than the sensor is farther, slower, weaker and nearer to "
               "boresight",
    .home = EFFECT_HOME_IDEAL,
    .cause = "mount_z_m of a sensor, z of a reflector",
    .bound = "for every reflector at the sensor's height",
    .cost = "two square roots and an angle per reflector",
};
