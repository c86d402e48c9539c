/* Amplitudes are those of the true range. */
#include "effects/effect.h"

#include "radar/folding.h"

static bool described(const struct effect_scan *scan)
{
    return scan->sensor->unambiguous_range_m > 0 || scan->sensor->unambiguous_rate_mps > 0;
}

static bool receive(const struct effect_scan *scan, struct effect_reception *reception)
{
    const struct sensor *sensor = scan->sensor;
    double range_m = reception->range_m, rate_mps = reception->range_rate_mps;
    if (sensor->unambiguous_range_m > 0)
        reception->range_m = folding_range_m(range_m, sensor->unambiguous_range_m);
    if (sensor->unambiguous_rate_mps > 0)
        reception->range_rate_mps = folding_range_rate_mps(rate_mps, sensor->unambiguous_rate_mps);
    return reception->range_m != range_m || reception->range_rate_mps != rate_mps;
}

const struct effect effect_ambiguity = {
    .summary = "ranges and range rates beyond what the waveform tells apart fold back",
    .home = EFFECT_HOME_SENSOR,
    .cause = "unambiguous_range_m, unambiguous_rate_mps of a sensor",
    .bound = "never: it costs as little",
    .cost = "two remainders per echo",
    .described = described,
    .receive = receive,
};
