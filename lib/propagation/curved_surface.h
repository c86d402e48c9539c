/* Echoes and reflections of smooth curved surfaces, near and far.
 *
 * By geometrical optics at the specular point, with radii of curvature r1 and r2 and distance R,
 *     sigma = pi r1 r2 R^2 / ((r1 + R) (r2 + R)).
 * Far away this is pi r1 r2. A plane has pi R^2, so that its amplitude falls as 1/R and not as
 * 1/R^2; a straight rail of profile radius r2 has pi r2 R^2 / (r2 + R) (MODEL 14.5).
 *
 * A wave that such a surface mirrors spreads more than behind a flat one. At an angle of incidence
 * of cosine c, with r1 in the plane of incidence and r2 across it, l1 from the source to the
 * surface and l2 from there on, its amplitude has the divergence factor D = 1/sqrt((1 + 2 d/(r1 c))
 * (1 + 2 d c/r2)),   d = l1 l2/(l1 + l2) of geometrical optics (Kouyoumjian and Pathak 1974;
 * MODEL 14.1). */
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
