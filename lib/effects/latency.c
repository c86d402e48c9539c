/* Simulated by stages/ideal.c, which looks at the scene that much earlier (MODEL 14.6). */
#include "effects/effect.h"

const struct effect effect_latency = {
    .summary = "a scan shows the world as it was some time before its time stamp",
    .cause = "latency_s of a sensor",
    .left_out_when = "the sensor's latency_s is 0",
    .cost = "a step of motion per object",
    .scene = "{object} moved since the measurement",
    .home = EFFECT_HOME_IDEAL,
    .members = {{EFFECT_SENSOR(latency_s)}},
};
