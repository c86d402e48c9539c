/* Fluctuation of echoes from scan to scan (MODEL 14.14). */
#include "effects/effect.h"

static bool receive(const struct effect_scan *scan, struct effect_reception *reception)
{
    const struct sensor *sensor = scan->sensor;
    if ((reception->echo->effects & EFFECT_BIT(EFFECT_ROADSIDE)) != 0)
        return false; /* roadside echoes have a level of their own */
    struct random_address address = frame_draw_address_in(scan->address, reception->echo->id);
    double uniform[4];
    random_uniform(&address, effect_fluctuation.purposes[0], 0, uniform);
    return effect_scale(reception, detection_fluctuation(sensor->fluctuation,
                                                         sensor->fluctuation_sigma_db, uniform));
}

const struct effect effect_fluctuation = {
    .summary = "the strength of an echo varies from scan to scan",
    .cause = "fluctuation of a sensor",
    .left_out_when = "the sensor's fluctuation is none",
    .cost = "a draw per echo",
    .home = EFFECT_HOME_SENSOR,
    .members = {{EFFECT_SENSOR(fluctuation)}},
    .purposes = {8},
    .receive = receive,
};
