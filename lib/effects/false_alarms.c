/* Simulated by noise/false_alarm_cells.c (MODEL 14.9). */
#include "effects/effect.h"

const struct effect effect_false_alarms = {
    .summary = "noise alone passes the threshold where there is no echo",
    .cause = "false_alarms of a sensor",
    .left_out_when = "the sensor's false_alarms are 0",
    .cost = "four draws per false alarm",
    .home = EFFECT_HOME_NOISE,
    .members = {{EFFECT_SENSOR(false_alarms)}},
    .purposes = {RANDOM_FALSE_ALARMS},
};
