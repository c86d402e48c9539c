/* Fluctuation of an echo's amplitude from scan to scan.
 *
 * The square of the factor on amplitude is a random power of mean 1 (MODEL 14.14):
 *
 *     Swerling 1   many equal scatterers: -ln u1, exponential
 *     Swerling 3   one dominant among many: -(ln u1 + ln u2)/2
 *     log-normal   10 lg power ~ N(mu, s), mu = -(ln 10/20) s^2, cut at mu + 3 s (3GPP TR 38.901)
 *
 * Swerling's cases 2 and 4 have the laws of 1 and 3, but change from look to look; here a scan is
 * one look, so that they are the same. The cut lowers the mean power of the log-normal law to Q(a -
 * 3) + exp(3 a - a^2/2) Q(3) with a = s ln 10/10 and the Gaussian tail Q: 0.997 for 3.41 dB. */
#pragma once

enum fluctuation_law {
    FLUCTUATION_NONE,
    FLUCTUATION_SWERLING_1,
    FLUCTUATION_SWERLING_3,
    FLUCTUATION_LOG_NORMAL,
};

/* The factor, from four independent uniform numbers in (0, 1). sigma_db >= 0 is s of the log-normal
 * law. Exactly 1 for FLUCTUATION_NONE, and for the log-normal law with 0 dB. */
double swerling_amplitude_factor(enum fluctuation_law law, double sigma_db,
                                 const double uniform[4]);
