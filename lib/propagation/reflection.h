/* Fresnel reflection at materials, curved surfaces, two-ray over roads.
 *
 * Permittivities are those of ITU-R P.2040-3, table 3. Its fits hold from 1 to 100 GHz, brick's to
 * 40 GHz, glass's from 0.1 GHz. The surface is that of a half space, the angle of incidence counts
 * from the normal (MODEL 14.1). The electric field is parallel to the surface (TE) or lies in the
 * plane of incidence (TM): an upright field is TE at a wall and TM at the road (MODEL 14.10). */
#pragma once

#include <complex.h>

#include "propagation/carrier.h"

enum material { MATERIAL_NONE, MATERIAL_CONCRETE, MATERIAL_BRICK, MATERIAL_GLASS, MATERIAL_METAL };
extern const char *const reflection_material_names[]; /* in documents, ending with NULL */

enum material_field { MATERIAL_TE, MATERIAL_TM };

struct material_permittivity {
    double real; /* eps' >= 1, relative */
    double loss; /* eps'' >= 0, relative */
};

/* The permittivity at carrier_hz > 0. MATERIAL_NONE has that of air, 1. */
struct material_permittivity reflection_permittivity(enum material material, double carrier_hz);

/* The coefficient, on amplitude, for cosine in [0, 1]: at most 1 in size, -1 at grazing incidence.
 */
double _Complex reflection_fresnel(const struct material_permittivity *permittivity,
                                   enum material_field field, double cosine);

/* Smooth curved surfaces have the radii of convex curvature r1 in the plane of incidence and r2
 * across it, in [0, infinity], where infinity is straight. The cross section at the specular point
 * is that of MODEL 14.5, by geometrical optics, and 0 if a radius or range_m >= 0 is 0. */
double reflection_curved_cross_section_m2(double radius_1_m, double radius_2_m, double range_m);

/* The divergence factor D of MODEL 14.1 on the amplitude of a wave that such a surface mirrors, in
 * [0, 1], as it spreads more than behind a flat one; for radii in (0, infinity], cosine in (0, 1]
 * and the distance d >= 0. */
double reflection_divergence(double radius_1_m, double radius_2_m, double cosine,
                             double distance_m);

/* ---- two-ray propagation over a reflecting road ----
 *
 * Each way, there and back, the wave goes straight and also by the road; the four paths interfere
 * in one range cell. The echo's amplitude is multiplied by the factor of MODEL 14.10, F^2 over its
 * root mean square over phase: cross sections measured above roads have that mean already. */

/* A road's surface. Dry asphalt has about 5 - j 0.25 and 1 mm, concrete 5.24 - j 0.42 at 24 GHz,
 * 5.24 - j 0.32 at 77 GHz, and 0.3 mm. */
struct two_ray_road {
    struct material_permittivity permittivity; /* eps' > 1 */
    double roughness_m;                        /* h >= 0 */
};

/* The sensor and a reflector over the road: heights >= 0, distance along the road >= 0. */
struct two_ray_ends {
    double sensor_height_m;
    double reflector_height_m; /* of the reflector's middle */
    double extent_m;           /* from the reflector's lowest to its highest part; 0 for a point */
    double distance_m;
};

struct two_ray_paths {
    double direct_m, bounced_m; /* R1, R2 */
    double difference_m;        /* delta, from 4 h_s h_r/(R1 + R2), which does not cancel */
    double spread_m;            /* by how much delta differs over the reflector's extent */
    double grazing_sine;        /* sin psi; 1 if both ends are one point of the road */
};

struct two_ray_paths reflection_two_ray_paths(const struct two_ray_ends *ends);

/* The coefficient g; |g| is at most 1, and g is -1 at grazing incidence. wavelength_m > 0. */
double _Complex reflection_road(const struct two_ray_road *road, enum polarization polarization,
                                double wavelength_m, double grazing_sine);

/* The power of the wave that arrives from the reflector's image below the road over that of the
 * direct one, |g|^2 (R1/R2)^2. */
double reflection_two_ray_image_power(const struct two_ray_paths *paths,
                                      double _Complex reflection);

/* The factor on an echo's amplitude, for |reflection| <= 1: the root of the mean of F^4 over the
 * reflector's extent, over that over all phases. At most 4/sqrt(6), and 1 without a reflection. */
double reflection_two_ray_factor(const struct two_ray_paths *paths, double _Complex reflection,
                                 double wavelength_m);
