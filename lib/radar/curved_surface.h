/* Cross section of a smooth curved surface, near and far.
 *
 * By geometrical optics at the specular point, with radii of curvature r1 and r2 and distance R,
 *     sigma = pi r1 r2 R^2 / ((r1 + R) (r2 + R)).
 * Far away this is pi r1 r2. A plane has pi R^2, so that its amplitude falls as 1/R and not as
 * 1/R^2; a straight rail of profile radius r2 has pi r2 R^2 / (r2 + R) (MODEL 14.5). */
#ifndef CURVED_SURFACE_H
#define CURVED_SURFACE_H

/* Radii of convex curvature in [0, infinity], where infinity is straight; range_m >= 0. Zero if a
 * radius or the range is 0. */
double curved_surface_cross_section_m2(double radius_1_m, double radius_2_m, double range_m);

/* The same surface's ERCS (radar_equation.h). */
double curved_surface_ercs(double radius_1_m, double radius_2_m, double range_m);

#endif
