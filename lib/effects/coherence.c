/* Phases of echoes; resolution cells and peaks add them up, and name the effect where they differ
 * (sensor/resolution_cell.h, sensor/smear.h). */
#include "effects/effect.h"

#include "base/units.h"
#include "frame/draw_address.h"
#include "radar/carrier.h"

static bool described(const struct effect_scan *scan)
{
    return scan->sensor->cell_phase != CELL_IN_PHASE;
}

/* Drawn in each frame, or that of the path and of the reflector, which is drawn once for all
 * frames. */
static double phase_rad(const struct effect_scan *scan, const struct echo *echo)
{
    const struct sensor *sensor = scan->sensor;
    struct random_address address = draw_address_in(scan->address, echo->id);
    double uniform[4];
    if (sensor->cell_phase == CELL_RANDOM_PHASE) {
        random_uniform(&address, RANDOM_PHASE, 0, uniform);
        return 2 * PI * uniform[0];
    }
    address.frame = 0;
    random_uniform(&address, RANDOM_REFLECTOR_PHASE, 0, uniform);
    return 2 * PI * (uniform[0] - carrier_phase_turns(echo->range_m, sensor->carrier_hz));
}

static bool receive(const struct effect_scan *scan, struct effect_reception *reception)
{
    reception->phase_rad = phase_rad(scan, reception->echo);
    return false;
}

const struct effect effect_coherence = {
    .summary = "echoes of one cell add with their phases and fade",
    .home = EFFECT_HOME_SENSOR,
    .cause = "cell_phase of a sensor",
    .bound = "cell_phase is in_phase",
    .cost = "a sine and cosine per echo",
    .described = described,
    .receive = receive,
};
