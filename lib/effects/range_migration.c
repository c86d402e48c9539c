/* Echoes that walk through range cells while they are measured (MODEL 14.20). The walk lowers the
 * amplitude here and widens the response in cells and peaks (radar/resolution.h, sensor/smear.h).
 * glint-sensor-signal has the walk in its samples instead. */
#include "effects/effect.h"

#include "radar/point_response.h"

/* Earlier effects may add echoes that walk, even if no echo of ideal does. */
static bool some_echo_walks(const struct effect_scan *scan)
{
    if (scan->adding != 0)
        return true;
    for (size_t i = 0; i < scan->echoes.count; i++)
        if (scan->echoes.items[i].range_rate_mps != 0)
            return true;
    return false;
}

static bool described(const struct effect_scan *scan)
{
    enum range_migration migration = scan->sensor->range_migration;
    return (migration == MIGRATION_RECTANGULAR || migration == MIGRATION_HANN) &&
           some_echo_walks(scan);
}

/* The cells of range that an echo of 1 m/s walks in a dwell. */
static const double *begin(const struct effect_scan *scan)
{
    const struct sensor *sensor = scan->sensor;
    return effect_constant(scan, sensor->dwell_s / sensor->bin_range_m);
}

static bool receive(const struct effect_scan *scan, struct effect_reception *reception)
{
    bool hann = scan->sensor->range_migration == MIGRATION_HANN;
    double cells = reception->constants[0] * reception->echo->range_rate_mps;
    struct point_response_walk walk =
        point_response_of_walk(hann ? POINT_RESPONSE_HANN : POINT_RESPONSE_RECTANGULAR, cells);
    reception->widening = walk.widening;
    return effect_scale(reception, walk.level) || walk.widening > 0;
}

const struct effect effect_range_migration = {
    .summary = "echoes that walk through range cells in a dwell fade and widen",
    .cause = "range_migration of a sensor",
    .left_out_when = "the sensor's range_migration names no window, or no echo moves in range",
    .cost = "two square roots per echo",
    .scene = "{object} walks through range cells",
    .home = EFFECT_HOME_SENSOR,
    .members = {{EFFECT_SENSOR(range_migration)}},
    .described = described,
    .begin = begin,
    .receive = receive,
};
