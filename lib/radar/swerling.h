/* Fluctuation of an echo's amplitude from scan to scan.
 *
 * The square of the factor on amplitude is a random power of mean 1, by the laws of MODEL 14.14:
 * Swerling 1 for many equal scatterers, Swerling 3 for one that dominates many, and a log-normal
 * law that is cut (3GPP TR 38.901), which lowers its mean to 0.997 for 3.41 dB. Swerling's cases 2
 * and 4 change from look to look; here a scan is one look, so that they are the same as 1 and 3. */
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
