/* Two-ray propagation over a reflecting road.
 *
 * Each way, there and back, the wave goes straight and also by the road; the four paths interfere
 * in one range cell. The echo's amplitude is multiplied by F^2 of MODEL 14.10, its power by F^4. */
#pragma once

#include <complex.h>

#include "propagation/carrier.h"
#include "propagation/material.h"

/* A road's surface. Dry asphalt has about 5 - j 0.25 and 1 mm, concrete 5.24 - j 0.42 at 24 GHz,
 * 5.24 - j 0.32 at 77 GHz, and 0.3 mm. */
struct road_mirror_road {
    struct material_permittivity permittivity; /* eps' > 1 */
    double roughness_m;                        /* h >= 0 */
};

/* The sensor and a reflector over the road: heights >= 0, distance along the road >= 0. */
struct road_mirror_ends {
    double sensor_height_m;
    double reflector_height_m; /* of the reflector's middle */
    double extent_m;           /* from the reflector's lowest to its highest part; 0 for a point */
    double distance_m;
};

struct road_mirror_paths {
    double direct_m, bounced_m; /* R1, R2 */
    double difference_m;        /* delta, from 4 h_s h_r/(R1 + R2), which does not cancel */
    double grazing_sine;        /* sin psi; 1 if both ends are one point of the road */
};

struct road_mirror_paths road_mirror_paths(const struct road_mirror_ends *ends);

/* The coefficient g; |g| is at most 1, and g is -1 at grazing incidence. wavelength_m > 0. */
double _Complex road_mirror_reflection(const struct road_mirror_road *road,
                                       enum polarization polarization, double wavelength_m,
                                       double grazing_sine);

/* F^2 of a point reflector, for any g. */
double road_mirror_point_factor(const struct road_mirror_paths *paths, double _Complex reflection,
                                double wavelength_m);

/* sqrt(<F^4>) = sqrt(1 + 4 G^2 + G^4) of a reflector so tall that phases average out. reflection is
 * G = |g| R1/R2. */
double road_mirror_mean_factor(double reflection);

/* The factor on an echo's amplitude: the mean factor if the reflector's extent is more than half a
 * lobe, whose height at the reflector is lambda R/(2 h_s), else the point factor. */
double road_mirror_amplitude_factor(const struct road_mirror_road *road,
                                    enum polarization polarization, double wavelength_m,
                                    const struct road_mirror_ends *ends);
