/* Soft shadows (EFFECTS 16): what the edge of a body lets through to a reflector behind it, as a
 * knife edge in ITU-R P.526.
 *
 * depth is how far the sight line lies inside the shadow at the edge, negative outside; d1 and d2
 * are the distances from the edge to both ends, which count as at least 0.1 m. */
#ifndef KNIFE_EDGE_H
#define KNIFE_EDGE_H

/* nu = depth sqrt(2 (d1 + d2)/(lambda d1 d2)); wavelength > 0. */
double knife_edge_parameter(double depth_m, double sensor_side_m, double reflector_side_m,
                            double wavelength_m);

/* J(nu) = 6.9 + 20 lg(sqrt((nu - 0.1)^2 + 1) + nu - 0.1), one way; 0 up to nu = -0.78. Within
 * 0.15 dB of Fresnel's integral from nu = -0.77 to 12. */
double knife_edge_loss_db(double parameter);

/* There and back: 10^(-2 J/20), in [0, 1], exactly 1 up to nu = -0.78. */
double knife_edge_amplitude_factor(double parameter);

/* Radius of the first Fresnel zone at the edge, sqrt(lambda d1 d2/(d1 + d2)). The factor is 1 from
 * 0.5516 of it outside the shadow. */
double knife_edge_fresnel_radius_m(double sensor_side_m, double reflector_side_m,
                                   double wavelength_m);

/* No edge farther than this from a sight line of that length changes what it lets through: the
 * largest first Fresnel radius that it has anywhere; 0 for a wavelength of 0. */
double knife_edge_reach_m(double range_m, double wavelength_m);

/* How high the straight line between both heights runs over the edge. A sight that is blocked in
 * the plane passes where this is more than the occluder's height; the occluder's height less this
 * is the depth under its upper edge. Distances as they are, not both 0. */
double knife_edge_ray_height_m(double sensor_height_m, double reflector_height_m,
                               double sensor_side_m, double reflector_side_m);

#endif
