/* How well a value can be read at a signal-to-noise ratio (EFFECTS 3). snr is a ratio of powers,
 * linear, at the peak of the integrated echo: (amplitude / noise RMS)^2. */
#ifndef SNR_SIGMA_H
#define SNR_SIGMA_H

/* One of range, range rate and sine of azimuth; everything in its unit. */
struct snr_sigma {
    double cell;   /* X: c/(2B), lambda/(2T) or lambda/(N d) */
    double factor; /* 0.39 is the Cramer-Rao bound sqrt(6)/(2 pi), 0.68 a Hann window */
    double floor;  /* what stays at any ratio */
    double step;   /* of the reported numbers; 0 for a value that is rounded afterwards */
};

/* The standard deviation: sigma^2 = (factor cell)^2 / snr + floor^2, at most that of a value
 * anywhere in the cell, cell^2 / 12, as noise alone says less than the cell itself at low ratios;
 * and step^2 / 12 for the rounding on top. Defined for snr = 0 and infinity. */
double snr_sigma_of(const struct snr_sigma *accuracy, double snr);

#endif
