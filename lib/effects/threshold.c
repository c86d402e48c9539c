/* Simulated by stages/sensor.c and those that stand in for it. */
#include "effects/effect.h"

const struct effect effect_threshold = {
    .summary = "cells whose summed amplitude is too weak are not detected",
    .home = EFFECT_HOME_SENSOR,
    .cause = "threshold_db of a sensor",
    .bound = "never: it costs nothing",
    .cost = "a comparison per cell",
};
