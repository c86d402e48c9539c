/* Probability that a sensor detects an echo of given amplitude.
 *
 * An echo of the mean amplitude A, fluctuating by the factor f (radar/swerling.h), is detected if
 * A f meets one threshold and |A f + n| another, n being complex Gaussian noise (MODEL 14.14). A
 * steady echo passes the second with Marcum's Q(sqrt 2 A/noise, sqrt 2 T/noise). */
#pragma once

#include "radar/swerling.h"

/* All amplitudes are linear and of one unit. */
struct detection_law {
    enum fluctuation_law fluctuation;
    double fluctuation_sigma_db; /* of the log-normal law */
    double threshold;            /* without noise; 0: none */
    double final_threshold;      /* with noise; 0: none */
    double noise;                /* RMS of n, both quadratures together; 0: none */
};

/* The probability that |amplitude + n| >= threshold, for amplitude >= 0 and threshold > 0: within
 * 1e-12. Below a 600th of the threshold, noise counts as none. */
double detection_in_noise(double amplitude, double threshold, double noise);

/* The probability that an echo of this mean amplitude > 0 is detected, within 1e-6. */
double detection_probability(const struct detection_law *detection, double amplitude);

/* The least mean amplitude that is detected with this probability in (0, 1), within 1e-6 of it. */
double detection_amplitude(const struct detection_law *detection, double probability);
