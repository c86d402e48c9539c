/* Swerling's fluctuation of echoes, and the probability of their detection.
 *
 * From scan to scan the amplitude of an echo varies by a random factor f, where f^2 has the mean 1
 * (MODEL 14.14): Swerling 1 for many equal scatterers, Swerling 3 for one that dominates many, and
 * a log-normal law cut at 3 standard deviations (3GPP TR 38.901), whose mean is 0.997 for 3.41 dB.
 * A scan is one look, so that Swerling's cases 2 and 4 are the same as 1 and 3.
 *
 * An echo of the mean amplitude A, which its body's level may change, is detected if A f meets one
 * threshold and |A f + n| another, with complex Gaussian noise n. A steady echo passes the second
 * threshold T with the probability Q(sqrt 2 A/noise, sqrt 2 T/noise), Marcum's function. The first
 * is lowered so far that it takes little from this (MODEL 8.4). */
#pragma once

enum fluctuation_law {
    FLUCTUATION_NONE,
    FLUCTUATION_SWERLING_1,
    FLUCTUATION_SWERLING_3,
    FLUCTUATION_LOG_NORMAL,
};

/* The factor f, from four independent uniform numbers in (0, 1). sigma_db >= 0 is s of the
 * log-normal law. Exactly 1 for FLUCTUATION_NONE, and for the log-normal law with 0 dB. */
double detection_fluctuation(enum fluctuation_law law, double sigma_db, const double uniform[4]);

/* All amplitudes are linear and of one unit. */
struct detection_law {
    enum fluctuation_law fluctuation;
    double fluctuation_sigma_db;          /* of the log-normal law */
    double threshold;                     /* without noise; 0: none */
    double final_threshold;               /* with noise; 0: none */
    double noise;                         /* RMS of n, both quadratures together; 0: none */
    double level_mean_db, level_sigma_db; /* of a normal level in dB (MODEL 14.22) beside f */
};

/* The threshold on amplitudes without noise where noise of this RMS >= 0 and a final threshold
 * follow; >= 0. It takes at most 0.011 from the probability of detection of steady echoes, if the
 * final one is 10 dB over the noise or more. */
double detection_lowered_threshold(double final_threshold, double noise);

/* The probability that |amplitude + n| >= threshold, for amplitude >= 0 and threshold > 0: within
 * 1e-12. Below a 600th of the threshold, noise counts as none. */
double detection_in_noise(double amplitude, double threshold, double noise);

/* The probability that an echo of this mean amplitude > 0 is detected, within 1e-6. */
double detection_probability(const struct detection_law *detection, double amplitude);

/* The least mean amplitude that is detected with this probability in (0, 1), within 1e-6 of it. */
double detection_amplitude(const struct detection_law *detection, double probability);
