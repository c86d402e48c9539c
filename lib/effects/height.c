/* Simulated by ideal/line_of_sight.c. */
#include "effects/effect.h"

const struct effect effect_height = {
    .summary = "of what occlusion hides, what is seen over a lower object appears",
    .home = EFFECT_HOME_IDEAL,
    .cause = "mount_z_m of a sensor",
    .bound = "where occlusion is left out",
    .cost = "a line's height per object in the way",
};
