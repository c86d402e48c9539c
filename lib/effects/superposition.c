/* Simulated by sensor/resolution_cell.c (MODEL 8). */
#include "effects/effect.h"

const struct effect effect_superposition = {
    .summary = "the angle of a cell is that of the sum of its echoes' pointers",
    .cause = "antenna_pattern of a sensor",
    .left_out_when = "every cell has one echo",
    .cost = "two pointers per echo",
    .scene = "{object} shares a cell",
    .home = EFFECT_HOME_SENSOR,
    .of_paper = true,
};
