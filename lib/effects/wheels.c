/* Points on rolling wheels (MODEL 14.11). */
#include "effects/effect.h"

#include "propagation/micro_doppler.h"

static bool described(const struct effect_scan *scan)
{
    return effect_any_moving_part(scan, MOVING_WHEEL);
}

static void add_points(const struct effect_scan *scan, const struct echo *hub,
                       struct effect_echoes *echoes)
{
    struct random_address address = frame_draw_address_in(scan->address, hub->id);
    double uniform[4];
    random_uniform(&address, effect_wheels.purposes[0], 0, uniform);
    int64_t count = random_poisson(MICRO_DOPPLER_WHEEL_COUNT, uniform[0]);
    for (int64_t number = 1; number <= count; number++) {
        struct echo point =
            effect_part_of_echo(hub, PATH_WHEEL, number, MICRO_DOPPLER_WHEEL_FACTOR, EFFECT_WHEELS);
        random_uniform(&address, effect_wheels.purposes[0], (uint32_t)number, uniform);
        point.range_rate_mps = micro_doppler_wheel_rate_mps(
            hub->range_rate_mps, hub->ground_rate_mps, micro_doppler_wheel_point(uniform));
        effect_add(scan, echoes, &point);
    }
}

static void add_echoes(const struct effect_scan *scan, struct effect_echoes *echoes)
{
    for (size_t i = 0; i < scan->echoes.count; i++)
        if (effect_has_moving_part(&scan->echoes.items[i], MOVING_WHEEL))
            add_points(scan, &scan->echoes.items[i], echoes);
}

static bool is_own(const struct echo_id *part)
{
    return part->path == PATH_WHEEL;
}

const struct effect effect_wheels = {
    .summary = "rolling wheels echo at other range rates than their vehicle",
    .cause = "micro_motion of a sensor, moving_part of a point",
    .left_out_when =
        "the sensor's micro_motion is false or no wheel in sight rolls along the sight line",
    .cost = "a draw per wheel and point on it",
    .scene = "wheels of {object} roll",
    .is_own = is_own,
    .home = EFFECT_HOME_SENSOR,
    .members = {{EFFECT_SENSOR(micro_motion)}},
    .purposes = {11}, /* per wheel house: number and rates of the points on its wheel */
    .described = described,
    .add_echoes = add_echoes,
};
