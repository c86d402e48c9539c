/* Azimuth read from the sum and delta channels.
 *
 * |delta|/|sum| tells the size of the azimuth, their relative phase its sign (MODEL 7.2, 7.4). */
#pragma once

#include "radar/antenna.h"

enum monopulse_estimator {
    /* The paper's rule, equation (7): the size from |delta| and |sum|, the sign from the phase
     * between them. Where the phase does not decide, sign_undecided is set. Under PHASE_ELEMENT the
     * last bit of a pointer may decide without that flag, if nearly equal echoes lie within about 1
     * degree to both sides of boresight; the azimuth is then below 7e-4 rad (hard case 11). */
    MONOPULSE_MAGNITUDE,
    /* The signed ratio -Im(delta conj(sum)) / |sum|^2: for one echo the same azimuth; for several
     * it changes continuously with the pointers. */
    MONOPULSE_RATIO,
    MONOPULSE_BEAMS, /* the maxima of an array's beams (radar/array.h): not read by this module */
};

struct monopulse_angle {
    bool valid; /* false if both pointers are zero: there is no azimuth */
    /* True if the phase does not tell left from right. Under MONOPULSE_RATIO that happens only if
     * the sum is exactly 0. */
    bool sign_undecided;
    double azimuth_rad; /* in [-pi/2, pi/2]; not negative if the sign is undecided; 0 if invalid */
};

struct monopulse_angle monopulse_angle(const struct antenna *antenna,
                                       enum monopulse_estimator estimator,
                                       struct antenna_pointers pointers);

/* The standard deviation of the azimuth of one echo by noise on both channels, to first order, at
 * the linear ratio of powers (|sum|/noise RMS)^2 = snr. With psi = atan(delta/sum) it is
 * cos psi/(sqrt(2 snr) |psi'|), which is that of MODEL 7.3 for the dipole pair. At the ends of a
 * table it is that of an azimuth just inside. On boresight the magnitude rule folds and takes the
 * noise of both quadratures: sqrt 2 times. */
double monopulse_sigma_rad(const struct antenna *antenna, enum monopulse_estimator estimator,
                           double azimuth_rad, double snr);

/* The part of delta/sum that a single echo does not have, Re(delta conj(sum))/|sum|^2, over its
 * standard deviation by noise of this RMS > 0 on each channel, sqrt((1 + |delta/sum|^2)/2)
 * noise/|sum|: for one echo a standard Gaussian number, to first order. 0 without a sum. */
double monopulse_quadrature(struct antenna_pointers pointers, double noise);

/* The margin of the sign under MONOPULSE_MAGNITUDE: |Im(delta conj(sum))| / (|delta| |sum|), from
 * 0, undecided, to 1. NaN if a pointer is zero. */
double monopulse_sign_margin(struct antenna_pointers pointers);
