/* Simulated by ideal/line_of_sight.c (MODEL 14.3). */
#include "effects/effect.h"

const struct effect effect_height = {
    .summary =
        "the sensor sees over objects that are low enough, and under those that are high enough",
    .cause = "mount_z_m of a sensor, height_m and clearance_m of an object's class",
    .left_out_when = "the sensor has no mount_z_m or occlusion is left out",
    .cost = "a height of the sight line per object in the way",
    .scene = "{object} is seen over or under others",
    .home = EFFECT_HOME_IDEAL,
    .members = {{EFFECT_SENSOR(mount_z_m)}},
};
