/* Standard deviation of a measured range, range rate or sine.
 *
 * By signal-to-noise ratio sigma^2 = min((factor cell)^2 / snr + sigma^2, cell^2 / 12), where
 * cell^2 / 12 is the variance of a value anywhere in the cell (MODEL 9, 14.7). */
#pragma once

enum sigma_law { SIGMA_FIXED, SIGMA_BY_AMPLITUDE, SIGMA_BY_SNR };

/* How one quantity is measured. Members have its unit unless they say otherwise. */
struct measurement_sigma {
    enum sigma_law law;
    double sigma;     /* fixed; by amplitude: at the threshold; by SNR: at an infinite ratio */
    double cell;      /* c/(2B), lambda/(2T) or lambda/(N d) */
    double factor;    /* 0.39 for the Cramer-Rao bound sqrt(6)/(2 pi), 0.68 for a Hann window */
    double threshold; /* linear amplitude */
    double noise;     /* RMS of the noise on the amplitude */
};

/* The standard deviation at an amplitude > 0, by the law: sigma; or sigma times
 * threshold/amplitude, that quotient at most 1; or measurement_sigma_at_snr at (amplitude/noise)^2.
 */
double measurement_sigma_at(const struct measurement_sigma *quantity, double amplitude);

/* The standard deviation by signal-to-noise ratio, whatever the law. snr is the linear ratio of
 * powers at the echo's peak in [0, infinity]. */
double measurement_sigma_at_snr(const struct measurement_sigma *quantity, double snr);
