#include "noise/measurement_noise.h"

#include <complex.h>

#include "base/elementary.h"
#include "effects/effect.h"

bool measurement_noise_read(const struct effect_scan *context, const struct cell *cell,
                            struct measurement *measurement)
{
    const struct sensor *sensor = context->sensor;
    struct effect_measurement read = effect_measurement_of(context, cell);
    effect_measure(context, EFFECT_STEP_POINTERS, &read);
    struct monopulse_angle angle =
        monopulse_angle(&sensor->antenna, sensor->angle_estimator, read.pointers);
    read.azimuth_rad = angle.azimuth_rad;
    effect_measure(context, EFFECT_STEP_NOISE, &read);
    effect_measure(context, EFFECT_STEP_AZIMUTH, &read);
    *measurement = (struct measurement){
        .cell = cell,
        .range_m = read.range_m,
        .azimuth_rad = read.azimuth_rad,
        .range_rate_mps = read.range_rate_mps,
        .amplitude = elementary_hypot(creal(read.pointers.sum), cimag(read.pointers.sum)),
        .sign_undecided = angle.sign_undecided,
        .effects = read.effects,
        .margins = cell->margins,
    };
    if (context->frame->margins)
        target_list_note_margins(sensor, cell, read.pointers, measurement->amplitude,
                                 effect_simulates(context, EFFECT_FINAL_THRESHOLD),
                                 &measurement->margins);
    return angle.valid;
}

void measurement_noise_turn(const struct effect_scan *context, struct measurement *measurement)
{
    struct effect_measurement read = {
        .cell = measurement->cell,
        .azimuth_rad = measurement->azimuth_rad,
        .effects = measurement->effects,
    };
    effect_measure(context, EFFECT_STEP_AZIMUTH, &read);
    measurement->azimuth_rad = read.azimuth_rad;
    measurement->effects = read.effects;
}
