/* Simulated by sensor/scan.c (MODEL 6). */
#include "effects/effect.h"

const struct effect effect_merging = {
    .summary = "echoes closer than the resolution share one cell",
    .cause = "cell_range_m and cell_range_rate_mps of a sensor",
    .left_out_when = "no two echoes are that close",
    .cost = "a test per pair of echoes",
    .scene = "{object} shares a cell",
    .home = EFFECT_HOME_SENSOR,
    .of_paper = true,
};
