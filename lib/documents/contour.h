/* Outline of an object as rows of equal scatterers (MODEL 2.7). The cross section of each of the
 * four faces is spread evenly over the face's length, as a density of power per metre, and gathered
 * in posts, one in the middle of each piece of the face.
 *
 * Posts are seen from their face's outer side, by a raised cosine over the angle off its normal
 * (directivity.h). It gives the face its whole cross section on the normal, half of the
 * oblique one at 45 degrees, where the next face adds the other half, and nothing from 90 degrees
 * on or before. So the powers of all posts in sight, added without regard to phase, make the
 * class's cross section on each normal and on each diagonal, whatever the spacing; an object longer
 * or wider than its class has more in proportion. */
#pragma once

#include "frame/reflectors.h"

/* Mean cross sections over scans by aspect; left and right are alike. */
struct contour {
    unsigned given; /* bits of the members that the document has: all or none */
    double front_dbsm, rear_dbsm, side_dbsm, oblique_dbsm;
};

extern const struct record contour_record;

/* The largest excess of the oblique cross section over another, in dB: half of the oblique one,
 * which each of two faces contributes, is then the whole of that face's. */
#define CONTOUR_OBLIQUE_DB 3.0

/* Refuses a larger oblique cross section, and a document with some members but not all. */
int contour_check(const struct contour *contour, struct diag *diag);

/* The angles off a face's normal up to which its posts are fully visible, and from which on they
 * are invisible. */
struct contour_view {
    double full_rad, zero_rad;
};
struct contour_view contour_view(double face_dbsm, double oblique_dbsm);

/* Replaces the set's points, planes and rows by four rows of posts, no farther apart than spacing_m
 * on an object of this size; mirrors and whether the object blocks stay. The sizes are at least
 * 0.01 m and the spacing 0.02 m. */
void contour_describe(const struct contour *contour, double length_m, double width_m,
                      double spacing_m, struct reflector_set *set, struct arena *arena);
