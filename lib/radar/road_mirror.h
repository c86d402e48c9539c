/* The road as a mirror under the sight line (EFFECTS 6): each way, there and back, the wave goes
 * straight and by way of the road, and the four paths interfere in one range cell.
 *
 *     F^4 = |1 + g (R1/R2) exp(-j 2 pi delta/lambda)|^4
 *
 * multiplies the echo's power, F^2 its amplitude. R1 is the direct path, R2 the one by the road,
 * delta their difference; g = Gamma rho_s is the road's effective reflection coefficient: Fresnel's
 * for the permittivity eps = eps' - j eps'' and the grazing angle psi, with s = sin psi and
 * r = sqrt(eps - cos^2 psi)
 *
 *     Gamma_H = (s - r)/(s + r),   Gamma_V = (eps s - r)/(eps s + r),
 *
 * times rho_s = exp(-8 (pi h sin psi/lambda)^2) for a surface whose heights have deviation h. */
#ifndef ROAD_MIRROR_H
#define ROAD_MIRROR_H

#include <complex.h>

#include "radar/carrier.h"

/* Dry asphalt is about 5 - j 0.25 with 1 mm; concrete 5.24 - j 0.42 at 24 and 5.24 - j 0.32 at
 * 77 GHz with 0.3 mm. */
struct road_mirror_road {
    double permittivity;      /* eps' > 1, relative */
    double permittivity_loss; /* eps'' >= 0 */
    double roughness_m;       /* >= 0 */
};

/* Both ends of the sight line; heights >= 0 over the road, the distance >= 0 along it. */
struct road_mirror_ends {
    double sensor_height_m;
    double reflector_height_m; /* of its middle */
    double extent_m;           /* from its lowest to its highest scatterer; 0 for a point */
    double distance_m;
};

struct road_mirror_paths {
    double direct_m, bounced_m;
    double difference_m; /* 4 h_s h_r/(R1 + R2): the subtraction would lose it */
    double grazing_sine; /* 1 where both ends are one point of the road */
};

struct road_mirror_paths road_mirror_paths(const struct road_mirror_ends *ends);

/* g, of size at most 1 and -1 at grazing incidence; wavelength > 0. */
double _Complex road_mirror_reflection(const struct road_mirror_road *road,
                                       enum polarization polarization, double wavelength_m,
                                       double grazing_sine);

/* F^2 of a point for any g. */
double road_mirror_point_factor(const struct road_mirror_paths *paths, double _Complex reflection,
                                double wavelength_m);

/* sqrt(<F^4>) = sqrt(1 + 4 g^2 + g^4) of a reflector so high that the phases average out;
 * reflection is |g| R1/R2. */
double road_mirror_mean_factor(double reflection);

/* All of the above: the factor on an echo's amplitude. The mean where the reflector's extent is
 * more than half a lobe, whose height at the reflector is lambda R/(2 h_s), else that of a point.
 */
double road_mirror_amplitude_factor(const struct road_mirror_road *road,
                                    enum polarization polarization, double wavelength_m,
                                    const struct road_mirror_ends *ends);

#endif
