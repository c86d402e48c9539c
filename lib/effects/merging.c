/* Simulated by sensor/scan.c. */
#include "effects/effect.h"

const struct effect effect_merging = {
    .summary = "echoes closer than the resolution share one cell",
    .home = EFFECT_HOME_SENSOR,
    .cause = "cell_range_m, cell_range_rate_mps of a sensor",
    .bound = "no two echoes are that close",
    .cost = "a test per pair of echoes",
};
