/* One echo as the receiver gets it. The radar equation and the antenna give it its amplitude (MODEL
 * 4), then every effect at home in the sensor changes it. */
#ifndef RECEIVED_ECHO_H
#define RECEIVED_ECHO_H

#include "documents/suite.h"
#include "frame/frame.h"

struct effect_scan;

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

/* The echo by the radar equation and the antenna pattern alone (MODEL 4). */
struct received_echo received_echo_in_free_space(const struct sensor *sensor,
                                                 const struct echo *echo, double phase_rad);

/* The echo with every effect that the scan simulates. */
struct received_echo received_echo_of(const struct effect_scan *context, const struct echo *echo);

#endif
