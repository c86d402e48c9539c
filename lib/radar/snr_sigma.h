/* Standard deviation of a measured value at a signal-to-noise ratio.
 *
 * sigma^2 = min((factor cell)^2 / snr + floor^2, cell^2 / 12) + step^2 / 12 (MODEL 14.7). cell^2 /
 * 12 is the variance of a value anywhere in the cell, step^2 / 12 that of rounding. */
#pragma once

/* How one quantity is measured: range, range rate or sine of azimuth. Members have its unit. */
struct snr_sigma {
    double cell;   /* c/(2B), lambda/(2T) or lambda/(N d) */
    double factor; /* 0.39 for the Cramer-Rao bound sqrt(6)/(2 pi), 0.68 for a Hann window */
    double floor;  /* sigma at an infinite ratio */
    double step;   /* of reported values; 0 if they are not rounded, or afterwards */
};

/* The standard deviation. snr is the linear ratio of powers at the echo's peak, (amplitude / noise
 * RMS)^2, in [0, infinity]. */
double snr_sigma_of(const struct snr_sigma *quantity, double snr);
