/* Diffraction loss at a knife edge by ITU-R P.526 (MODEL 14.4).
 *
 * depth_m is how far the sight line lies inside the shadow at the edge, negative outside; d1 and d2
 * are the distances from the edge to sensor and reflector, which count as at least 0.1 m. */
#pragma once

/* nu = depth sqrt(2 (d1 + d2)/(lambda d1 d2)); wavelength > 0. */
double knife_edge_parameter(double depth_m, double sensor_side_m, double reflector_side_m,
                            double wavelength_m);

/* The factor on amplitude for both ways, 10^(-2 J/20), in [0, 1]. J(nu) = 6.9 + 20 lg(sqrt((nu -
 * 0.1)^2 + 1) + nu - 0.1) dB is the loss of one way, 0 dB up to nu = -0.78, where the factor is
 * exactly 1. J is within 0.15 dB of Fresnel's integral from nu = -0.77 to 12. */
double knife_edge_amplitude_factor(double parameter);

/* No edge farther than this from a sight line of length range_m changes the factor: the largest
 * first Fresnel radius along the line. 0 for a wavelength of 0. */
double knife_edge_reach_m(double range_m, double wavelength_m);
