/* Lobe of a scattering point by 3GPP TR 38.901, 7.9.2. In decibels it is a parabola in azimuth plus
 * another in zenith angle, each and both together at most depth_db deep:
 *
 *     drop = min(12 (off/width)^2, depth) + min(12 ((zenith - middle)/width)^2, depth)
 *
 * and at most depth_db in all. Half a width off the middle the lobe is 3 dB down. */
#pragma once

struct lobe {
    double width_rad;        /* in azimuth, between the two angles 3 dB down; 0: no drop in
                              * azimuth */
    double zenith_rad;       /* of the lobe's middle; 0 is straight up, pi/2 level */
    double zenith_width_rad; /* as width_rad, in zenith angle; 0: no drop in height */
    double depth_db;         /* 0: no lobe, the factor is 1 everywhere */
};

/* The factor on amplitude, in (0, 1], for a viewer whose azimuth is off_rad in [0, pi] from the
 * lobe's middle and whose zenith angle, seen from the point, is zenith_rad. */
double lobe_amplitude_factor(const struct lobe *lobe, double off_rad, double zenith_rad);
