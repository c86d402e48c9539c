/* Folds ranges and range rates (MODEL 14.16); amplitudes stay those of the true range. */
#include "effects/effect.h"

#include "radar/folding.h"

static bool receive(const struct effect_scan *scan, struct effect_reception *reception)
{
    const struct sensor *sensor = scan->sensor;
    double range_m = reception->range_m;
    double rate_mps = reception->range_rate_mps;
    if (sensor->unambiguous_range_m > 0)
        reception->range_m = folding_range_m(range_m, sensor->unambiguous_range_m);
    if (sensor->unambiguous_rate_mps > 0)
        reception->range_rate_mps = folding_range_rate_mps(rate_mps, sensor->unambiguous_middle_mps,
                                                           sensor->unambiguous_rate_mps);
    return reception->range_m != range_m || reception->range_rate_mps != rate_mps;
}

const struct effect effect_ambiguity = {
    .summary = "ranges and range rates outside the unambiguous interval fold into it",
    .cause = "unambiguous_range_m and unambiguous_rate_mps of a sensor",
    .left_out_when = "the sensor has neither unambiguous_range_m nor unambiguous_rate_mps",
    .cost = "two remainders per echo",
    .scene = "{object} is folded",
    .home = EFFECT_HOME_SENSOR,
    .of_paper = true, /* as the waveform folds, which all chains have */
    .members = {{EFFECT_SENSOR(unambiguous_range_m)}, {EFFECT_SENSOR(unambiguous_rate_mps)}},
    .receive = receive,
};
