#include "noise/measurement_noise.h"

#include <complex.h>

#include "base/elementary.h"

bool measurement_noise_read(const struct effect_scan *context, const struct cell *cell,
                            struct effect_measurement *measurement)
{
    const struct sensor *sensor = context->sensor;
    *measurement = effect_measurement_of(context, cell);
    effect_measure(context, EFFECT_STEP_POINTERS, measurement);
    struct monopulse_angle angle =
        monopulse_angle(&sensor->antenna, sensor->angle_estimator, measurement->pointers);
    measurement->azimuth_rad = angle.azimuth_rad;
    measurement->sign_undecided = angle.sign_undecided;
    measurement->amplitude =
        elementary_hypot(creal(measurement->pointers.sum), cimag(measurement->pointers.sum));
    effect_measure(context, EFFECT_STEP_NOISE, measurement);
    effect_measure(context, EFFECT_STEP_AZIMUTH, measurement);
    if (frame_carries(context->frame, CARRY_MARGINS))
        target_list_note_margins(sensor, cell, measurement->pointers, measurement->amplitude,
                                 effect_simulates(context, EFFECT_FINAL_THRESHOLD),
                                 &measurement->margins);
    return angle.valid;
}
