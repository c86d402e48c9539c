/* How an echo's strength varies from look to look (EFFECTS 1): a factor on its amplitude whose
 * square, the factor on power, has mean 1.
 *
 *     Swerling 1, 2   many equal scatterers: power -ln u1, exponential
 *     Swerling 3, 4   one dominant among many: power -(ln u1 + ln u2)/2
 *     log-normal      10 lg power ~ N(mu, s), mu = -(ln 10/20) s^2, cut at mu + 3 s (TR 38.901)
 *
 * Cases 1 and 3 are constant within a scan and new in the next, 2 and 4 are new in every look. Here
 * a scan is one look and the address of a draw contains the frame, so that 1 and 2 are one law, and
 * so are 3 and 4. Case 0 is no fluctuation. The cut lowers the log-normal's mean power to
 * Q(a - 3) + exp(3 a - a^2/2) Q(3) with a = s ln 10/10, Q the Gaussian tail: 0.997 for 3.41 dB. */
#ifndef SWERLING_H
#define SWERLING_H

enum fluctuation_law {
    FLUCTUATION_NONE,
    FLUCTUATION_SWERLING_1,
    FLUCTUATION_SWERLING_3,
    FLUCTUATION_LOG_NORMAL,
};

/* uniform is a block of random_uniform; sigma_db >= 0 counts for the log-normal law only. Exactly 1
 * without fluctuation and for a log-normal of 0 dB. */
double swerling_amplitude_factor(enum fluctuation_law law, double sigma_db,
                                 const double uniform[4]);

#endif
