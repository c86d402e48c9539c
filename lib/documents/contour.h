/* An object's outline as a line of equal scatterers (EFFECTS 2.4): the cross section of each of its
 * four faces, spread evenly over the face's length as a density of power per metre and gathered
 * again in posts, one in the middle of each piece.
 *
 * Posts are seen from their face's outer side, by a raised cosine over the angle off its normal
 * (visibility_range.h) that gives the face all of its own cross section on the normal, half of the
 * oblique one at 45 degrees, where the next face adds the other half, and nothing from 90 degrees
 * on or before. So the powers of all posts in sight, added without regard to phase, are the
 * class's cross section on each normal and on each diagonal, whatever the spacing; on an object
 * that is longer or wider than its class, more in proportion. */
#ifndef CONTOUR_H
#define CONTOUR_H

#include "frame/reflectors.h"

/* Means over scans, of one aspect each; left and right are alike. */
struct contour {
    unsigned given; /* which members are: all or none */
    double front_dbsm, rear_dbsm, side_dbsm, oblique_dbsm;
};

extern const struct record contour_record;

/* How far the oblique cross section may be above another: half of it, from each of two faces, is
 * then what the face itself has. */
#define CONTOUR_OBLIQUE_DB 3.0

/* Refuses an oblique cross section beyond that, and some members without the others. */
int contour_check(const struct contour *contour, struct diag *diag);

/* The angles off a face's normal up to which its posts are fully visible, and from which on they
 * are not. */
struct contour_view {
    double full_rad, zero_rad;
};
struct contour_view contour_view(double face_dbsm, double oblique_dbsm);

/* Puts four rows of posts, no farther apart than spacing_m on an object of this size, in place of
 * the set's points, planes and rows; mirrors and what its outline hides stay. The sizes are at
 * least 0.01 m and the spacing 0.02 m. */
void contour_describe(const struct contour *contour, double length_m, double width_m,
                      double spacing_m, struct reflector_set *set, struct arena *arena);

#endif
