/* Simulated by sensor/resolution_cell.c. */
#include "effects/effect.h"

const struct effect effect_superposition = {
    .summary = "the angle of a cell is that of its added sum and delta pointers",
    .home = EFFECT_HOME_SENSOR,
    .cause = "antenna_pattern of a sensor",
    .bound = "every cell has one member",
    .cost = "two pointers per member",
};
