/* What a receiver gets of the echoes of one scan: every factor on their amplitudes between ideal
 * view and antenna, their phases, where ambiguity folds them to, and the noise they compete with.
 *
 * The factors apply in this order, each only where a document describes its cause: radar equation
 * and cross section (MODEL 4), the road as a mirror (EFFECTS 6), fluctuation (1), rain and fog
 * (13). Range and rate are folded after that (10), so amplitudes are those of the true range.
 *
 * The road counts for echoes with a known height: direct ones and what moves on their reflectors.
 * Ghosts and clutter have none. What sees effects begin here also says what has them: the parts
 * that move and the clutter that are at home in scatterers.h.
 *
 * An interferer is heard where its object stands in this frame, if it is in view: one that has left
 * the scene, or is the ego, is not heard (12). */
#ifndef RECEIVED_ECHO_H
#define RECEIVED_ECHO_H

#include "frame/draw_address.h"
#include "radar/attenuation.h"
#include "radar/road_mirror.h"
#include "sensor/resolution_cell.h"

struct reception {
    const struct frame *frame;
    const struct sensor *sensor;
    double time_s;    /* of the measurement */
    uint64_t effects; /* to simulate */
    double rain_dbpkm, fog_dbpkm;
    struct road_mirror_road road;
    struct random_address address; /* of the scan */
    double interference;           /* of all other radars, over the noise, in power */
};

/* The effects at home here that the documents describe for this scan. */
uint64_t received_echo_described(const struct frame *frame, const struct sensor *sensor);

struct reception received_echo_begin(const struct frame *frame, const struct sensor *sensor,
                                     uint64_t effects);

/* Notes every effect that is at home here: all that is described and may be is simulated. */
void received_echo_note(const struct reception *reception, const struct selection *selection);

/* Has this echo a wheel that turns, or limbs that swing, along the sight line? */
bool received_echo_rolls(const struct echo *echo);
bool received_echo_walks(const struct echo *echo);

/* The echo as it is received. */
struct received_echo received_echo_of(const struct reception *reception, const struct echo *echo);

#endif
