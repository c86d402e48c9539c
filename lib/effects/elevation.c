/* Simulated by ideal/look.c (MODEL 14.2). */
#include "effects/effect.h"

const struct effect effect_elevation = {
    .summary = "a reflector above or below the sensor is farther away, slower, weaker and nearer "
               "to boresight",
    .cause = "mount_z_m of a sensor, z of a reflector",
    .left_out_when = "the sensor has no mount_z_m or all reflectors in sight are at its height",
    .cost = "two square roots and an angle per reflector",
    .scene = "{object} is above or below the sensor",
    .home = EFFECT_HOME_IDEAL,
    .members = {{EFFECT_SENSOR(mount_z_m)}},
};
