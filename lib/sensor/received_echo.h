/* One echo as the sensor's receiver gets it.
 *
 * The amplitude follows from the radar equation and the antenna (MODEL 4). Then the effects of the
 * sensor stage change the echo. */
#pragma once

#include "documents/suite.h"
#include "frame/frame.h"

struct effect_scan;

struct received_echo {
    struct contributor echo;        /* the ideal values, with weight 0 */
    double strength;                /* G = A_ref(R) ERCS, before the antenna */
    double amplitude;               /* A = G A_phi, equation (2) */
    double range_m, range_rate_mps; /* as the radar measures them, perhaps folded */
    double elevation_rad;           /* of the echo with its image in the road, by their powers */
    double phase_rad;               /* relative to others; 0 in the paper */
    double widening;                /* its cell is 1 + widening times as large as the sensor's */
    uint64_t effects;               /* the effects that changed the echo or one of these values */
    const struct margins *margins;
};

/* The echo after the radar equation and the antenna pattern alone (MODEL 4). */
struct received_echo received_echo_in_free_space(const struct sensor *sensor,
                                                 const struct echo *echo, double phase_rad);

/* The echo after all effects that the scan simulates. */
struct received_echo received_echo_of(const struct effect_scan *context, const struct echo *echo);
