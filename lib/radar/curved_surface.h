/* The cross section of a smooth curved surface near enough to be no point (EFFECTS 2.2, 17):
 * geometrical optics at the specular point, with radii of curvature r1 and r2 and distance R,
 *     sigma = pi r1 r2 R^2 / ((r1 + R) (r2 + R)).
 * Far away it is pi r1 r2; a plane has pi R^2, so that its amplitude falls as 1/R and not as 1/R^2;
 * a straight rail of profile r2 has pi r2 R^2 / (r2 + R). */
#ifndef CURVED_SURFACE_H
#define CURVED_SURFACE_H

/* Convex radii from 0 to infinity (a straight line has infinity), range_m >= 0. 0 for a radius or
 * a range of 0. */
double curved_surface_cross_section_m2(double radius_1_m, double radius_2_m, double range_m);

/* The same as ERCS, the amplitude factor (radar_equation.h). */
double curved_surface_ercs(double radius_1_m, double radius_2_m, double range_m);

#endif
