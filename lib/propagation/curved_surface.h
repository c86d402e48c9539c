/* Echoes and reflections of smooth curved surfaces, near and far.
 *
 * Radii of curvature are r1 in the plane of incidence and r2 across it. Sigma at the specular point
 * is that of MODEL 14.5, by geometrical optics; a wave that such a surface mirrors spreads more
 * than behind a flat one, by the divergence factor D of MODEL 14.1. */
#pragma once

/* Radii of convex curvature in [0, infinity], where infinity is straight; range_m >= 0. Zero if a
 * radius or the range is 0. */
double curved_surface_cross_section_m2(double radius_1_m, double radius_2_m, double range_m);

/* The same surface's ERCS (radar_equation.h). */
double curved_surface_ercs(double radius_1_m, double radius_2_m, double range_m);

/* The factor D on the amplitude of a mirrored wave, in [0, 1], for radii in (0, infinity], cosine
 * in (0, 1] and the distance d >= 0. */
double curved_surface_divergence(double radius_1_m, double radius_2_m, double cosine,
                                 double distance_m);
