#include "documents/suite_effects.h"

#define LONG_RANGE_M 150 /* radars that look farther are of another class than those of corners */

uint64_t suite_effects_missing(const struct sensor *sensor)
{
    bool levels =
        sensor->level_constant_db > 0 || sensor->level_slow_db > 0 || sensor->level_fast_db > 0;
    bool steps =
        sensor->range_step_m > 0 || sensor->range_rate_step_mps > 0 || sensor->azimuth_step_rad > 0;
    const struct {
        enum effect_id effect;
        bool described;
    } effects[] = {
        {EFFECT_LATENCY, sensor->latency_s > 0},
        {EFFECT_CURVATURE, sensor->curved_sides},
        {EFFECT_ELEVATION, sensor->mount_z_m > 0},
        {EFFECT_HEIGHT, sensor->mount_z_m > 0},
        {EFFECT_DIFFRACTION, sensor->diffraction},
        {EFFECT_GHOSTS, sensor->bounces >= 2},
        {EFFECT_WHEELS, sensor->micro_motion},
        {EFFECT_LIMBS, sensor->micro_motion},
        {EFFECT_TWO_RAY, sensor->mount_z_m > 0},
        {EFFECT_FLUCTUATION, levels || sensor->fluctuation != FLUCTUATION_NONE},
        {EFFECT_LEVEL, levels},
        {EFFECT_RANGE_MIGRATION, sensor->range_migration != MIGRATION_NONE},
        {EFFECT_AMBIGUITY, sensor->unambiguous_range_m > 0 || sensor->unambiguous_rate_mps > 0},
        {EFFECT_INTERFERENCE, sensor->receiver_bandwidth_hz > 0},
        {EFFECT_COHERENCE, sensor->cell_phase != CELL_IN_PHASE},
        {EFFECT_ANGLE_NOISE, sensor->pointer_sigma > 0 || sensor->azimuth_floor_rad > 0},
        {EFFECT_RANGE_NOISE, sensor->range_sigma_m > 0 || sensor->range_rate_sigma_mps > 0 ||
                                 sensor->sigma_law == SIGMA_BY_SNR},
        {EFFECT_ACCURACY, sensor->sigma_law != SIGMA_FIXED},
        {EFFECT_MISALIGNMENT, sensor->misalignment_rad != 0 || sensor->radome_bias_rad > 0},
        {EFFECT_FINAL_THRESHOLD, sensor->final_threshold},
        {EFFECT_FALSE_ALARMS, sensor->false_alarms > 0},
        {EFFECT_LIST_LIMIT, sensor->list_limit > 0},
        {EFFECT_QUANTISATION, steps},
    };
    uint64_t missing = 0;
    for (size_t i = 0; i < sizeof effects / sizeof effects[0]; i++)
        if (!effects[i].described)
            missing |= EFFECT_BIT(effects[i].effect);
    return missing;
}

struct suite_effects_example suite_effects_example(const struct sensor *sensor)
{
    if (sensor->range_max_m > LONG_RANGE_M)
        return (struct suite_effects_example){"lrr77-full", EFFECT_BIT(EFFECT_COHERENCE)};
    return (struct suite_effects_example){"radarscenes77-full", EFFECT_BIT(EFFECT_QUANTISATION)};
}
