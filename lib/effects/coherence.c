/* Gives echoes their phases (MODEL 8.2, 14.18). Cells and peaks add pointers with these phases, and
 * are labelled if they differ (sensor/resolution_cell.h, sensor/smear.h). */
#include "effects/effect.h"

#include "base/units.h"
#include "propagation/carrier.h"

/* The purposes of its draws. */
enum { OF_FRAME, OF_REFLECTOR };

/* A random phase is drawn anew in each frame. A phase by path is that of the way there and back,
 * plus one of the reflector that is drawn once for all frames. */
static double phase_rad(const struct effect_scan *scan, const struct echo *echo)
{
    const struct sensor *sensor = scan->sensor;
    struct random_address address = frame_draw_address_in(scan->address, echo->id);
    double uniform[4];
    if (sensor->cell_phase == CELL_RANDOM_PHASE) {
        random_uniform(&address, effect_coherence.purposes[OF_FRAME], 0, uniform);
        return 2 * PI * uniform[0];
    }
    address.frame = 0;
    random_uniform(&address, effect_coherence.purposes[OF_REFLECTOR], 0, uniform);
    return 2 * PI * (uniform[0] - carrier_phase_turns(echo->range_m, sensor->carrier_hz));
}

static bool receive(const struct effect_scan *scan, struct effect_reception *reception)
{
    reception->phase_rad = phase_rad(scan, reception->echo);
    return false;
}

const struct effect effect_coherence = {
    .summary = "echoes of one cell add with their phases, so that cells fade",
    .cause = "cell_phase of a sensor",
    .left_out_when = "the sensor's cell_phase is in_phase",
    .cost = "a sine and a cosine per echo",
    .scene = "{object} shares a cell",
    .home = EFFECT_HOME_SENSOR,
    .members = {{EFFECT_SENSOR(cell_phase)}},
    .purposes = {[OF_FRAME] = 4, [OF_REFLECTOR] = 7},
    .receive = receive,
};
