/* The lobe of a scattering point, as 3GPP TR 38.901, 7.9.2 has it (EFFECTS 2.3): in decibels a
 * parabola in azimuth and another in zenith angle, each and both together at most depth_db deep.
 *
 *     drop = min(12 (off/width)^2, depth) + min(12 ((zenith - middle)/width)^2, depth),
 *     at most depth: half of a width off the middle it is 3 dB */
#ifndef LOBE_H
#define LOBE_H

struct lobe {
    double width_rad;        /* in azimuth, 3 dB down at both ends; 0: the same all around */
    double zenith_rad;       /* of its middle; 0 is straight up, pi/2 level */
    double zenith_width_rad; /* as width_rad; 0: the same at every height */
    double depth_db;         /* 0: there is no lobe */
};

/* The factor on amplitude, in (0, 1], for a viewer off_rad in [0, pi] beside the middle and at
 * zenith_rad as the point sees it. */
double lobe_amplitude_factor(const struct lobe *lobe, double off_rad, double zenith_rad);

#endif
