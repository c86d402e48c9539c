/* One echo as the sensor's receiver gets it.
 *
 * The radar equation and the antenna give the echo its amplitude (MODEL 4); then the effects at
 * home in the sensor change it. */
#pragma once

#include "documents/suite.h"
#include "frame/frame.h"

struct effect_scan;

struct received_echo {
    struct contributor echo;        /* the ideal values, with weight 0 */
    double strength;                /* G = A_ref(R) ERCS, before the antenna pattern of arrival */
    double amplitude;               /* A = G A_phi, equation (2) */
    double range_m, range_rate_mps; /* as the radar reads them: the echo's, or folded */
    double phase_rad;               /* cells use its difference from the leader's; 0 in the paper */
    double widening;                /* its cell is 1 + widening times as large as the sensor's */
    uint64_t effects; /* the effects that changed the echo, its amplitude, range or range rate */
    const struct margins *margins; /* the echo's */
};

/* The echo by the radar equation and the antenna pattern alone (MODEL 4). */
struct received_echo received_echo_in_free_space(const struct sensor *sensor,
                                                 const struct echo *echo, double phase_rad);

/* The echo with every effect that the scan simulates. */
struct received_echo received_echo_of(const struct effect_scan *context, const struct echo *echo);
