/* Arms and legs of people who walk (MODEL 14.12). */
#include "effects/effect.h"

#include "base/elementary.h"
#include "propagation/micro_doppler.h"

static bool described(const struct effect_scan *scan)
{
    return effect_any_moving_part(scan, MOVING_LIMBS);
}

/* Moves a limb offset_m ahead of the torso, along the person's heading. */
static void shift(struct echo *limb, double offset_m)
{
    double aside_rad = limb->heading_rad - limb->azimuth_rad;
    double along_m = limb->range_m + offset_m * elementary_cos(aside_rad);
    double across_m = offset_m * elementary_sin(aside_rad);
    limb->range_m = elementary_hypot(along_m, across_m);
    limb->azimuth_rad += elementary_atan2(across_m, along_m);
}

static void add_limbs(const struct effect_scan *scan, const struct echo *torso,
                      struct effect_echoes *echoes)
{
    struct random_address address = frame_draw_address_in(scan->address, torso->id);
    double uniform[4];
    random_uniform(&address, effect_limbs.purposes[0], 0, uniform);
    int64_t count = random_poisson(MICRO_DOPPLER_LIMB_COUNT, uniform[0]);
    for (int64_t number = 1; number <= count; number++) {
        struct echo part =
            effect_part_of_echo(torso, PATH_LIMB, number, MICRO_DOPPLER_LIMB_FACTOR, EFFECT_LIMBS);
        random_uniform(&address, effect_limbs.purposes[0], (uint32_t)number, uniform);
        struct limb limb = micro_doppler_limb(uniform);
        part.range_rate_mps =
            micro_doppler_limb_rate_mps(torso->range_rate_mps, torso->ground_rate_mps, limb);
        shift(&part, limb.offset_m);
        effect_add(scan, echoes, &part);
    }
}

static void add_echoes(const struct effect_scan *scan, struct effect_echoes *echoes)
{
    for (size_t i = 0; i < scan->echoes.count; i++)
        if (effect_has_moving_part(&scan->echoes.items[i], MOVING_LIMBS))
            add_limbs(scan, &scan->echoes.items[i], echoes);
}

static bool is_own(const struct echo_id *part)
{
    return part->path == PATH_LIMB;
}

const struct effect effect_limbs = {
    .summary = "arms and legs echo at other range rates than the torso",
    .cause = "micro_motion of a sensor, moving_part of a point",
    .left_out_when =
        "the sensor's micro_motion is false or nobody in sight walks along the sight line",
    .cost = "a draw per person and limb",
    .scene = "limbs of {object} swing",
    .is_own = is_own,
    .home = EFFECT_HOME_SENSOR,
    .members = {{EFFECT_SENSOR(micro_motion)}},
    .purposes = {12}, /* per person: number and rates of arms and legs */
    .described = described,
    .add_echoes = add_echoes,
};
