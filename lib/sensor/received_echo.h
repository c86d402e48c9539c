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

#include "base/random.h"
#include "documents/suite.h"
#include "frame/frame.h"
#include "radar/attenuation.h"
#include "radar/road_mirror.h"

/* An echo with what the antenna and the radar equation make of it. */
struct received_echo {
    struct contributor echo;
    double strength;  /* G = A_ref(R) ERCS: the amplitude before the antenna of its arrival */
    double amplitude; /* A = G A_phi, equation (2) */
    double range_m, range_rate_mps; /* as the radar reads them: the echo's, or folded */
    double phase_rad; /* counts relative to the leader of the cell; 0 in the paper's model */
    uint64_t effects; /* the echo's, and those of its amplitude and phase */
    const struct margins *margins; /* the echo's */
};

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

/* The echo by the radar equation and the antenna pattern alone (MODEL 4). */
struct received_echo received_echo_in_free_space(const struct sensor *sensor,
                                                 const struct echo *echo, double phase_rad);

/* The echo with every factor that the reception simulates. */
struct received_echo received_echo_of(const struct reception *reception, const struct echo *echo);

#endif
