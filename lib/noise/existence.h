/* Probability that a detection is an echo and not noise.
 *
 * Bayes' rule for a detection of power z in units of the noise's (MODEL 14.21): echoes are expected
 * to have exponential powers from least_echo on, and noise alone from least_false_alarm on. */
#pragma once

struct existence {
    double echoes;                        /* mean number in a scan, detected or not; > 0 */
    double snr;                           /* mean ratio of their powers to that of the noise; > 0 */
    double false_alarms;                  /* mean number in a scan */
    double least_false_alarm, least_echo; /* powers that the thresholds let pass; 0: all */
    double rise;                          /* of the noise's power by other radars, >= 1 */
};

/* The probability, in [0, 1], for a power >= 0. What can be neither an echo nor noise counts as an
 * echo. */
double existence_probability(const struct existence *existence, double power);
