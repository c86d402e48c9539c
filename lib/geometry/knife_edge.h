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

/* There and back: 10^(-2 J/20), in [0, 1], where J(nu) = 6.9 + 20 lg(sqrt((nu - 0.1)^2 + 1) + nu -
 * 0.1) is one way, 0 dB up to nu = -0.78: exactly 1 there. J is within 0.15 dB of Fresnel's
 * integral from nu = -0.77 to 12. */
double knife_edge_amplitude_factor(double parameter);

/* No edge farther than this from a sight line of that length changes what it lets through: the
 * largest first Fresnel radius that it has anywhere; 0 for a wavelength of 0. */
double knife_edge_reach_m(double range_m, double wavelength_m);

#endif
