/* Other reflectors of a class: its contour, 3GPP's sensing targets.
 *
 * A vehicle document may have mean cross sections of its class (MODEL 2.7) or name a sensing target
 * of 3GPP (MODEL 2.8). Each replaces the points, planes and rows of the reflector set. */
#pragma once

#include "base/random.h"
#include "frame/reflectors.h"

/* Mean cross sections over scans by aspect, left and right alike. Each of the four faces divides
 * its cross section evenly over its length among posts, one in the middle of each piece.
 *
 * The visibility of a post is a raised cosine over the angle off the face's normal (directivity.h).
 * A face has its whole cross section on the normal, half of the oblique one at 45 degrees, where
 * the next face adds the other half, and none from 90 degrees on. So the powers of all posts in
 * sight add up to the class's cross section on each normal and on each diagonal, whatever the
 * spacing; the cross section grows with the length and width of an object. */
struct contour {
    unsigned given; /* bits of the members that the document has: all or none */
    double front_dbsm, rear_dbsm, side_dbsm, oblique_dbsm;
};

extern const struct record contour_record;

/* The most by which the oblique cross section exceeds another, in dB: each of two faces then
 * contributes its whole cross section at 45 degrees. */
#define REFLECTOR_MODELS_OBLIQUE_DB 3.0

/* Refuses a larger oblique cross section, and a document with some members but not all. */
int reflector_models_check_contour(const struct contour *contour, struct diag *diag);

/* Posts are fully visible up to full_rad off the face's normal, and invisible from zero_rad on. */
struct contour_view {
    double full_rad, zero_rad;
};
struct contour_view reflector_models_contour_view(double face_dbsm, double oblique_dbsm);

/* How the scatterers of a contour are spaced and seen, and how they differ from one another. A
 * member below 0 is not stated. */
struct surface {
    double spacing_m;          /* from one scatterer to the next, at most */
    double facing_sigma_rad;   /* of its facing around the face's normal */
    double full_rad, zero_rad; /* its view, both or none; none: that of its face */
    double level_sigma_db;     /* of its power around its mean */
};

extern const struct record surface_record;

/* What holds where nothing is stated: scatterers 0.1 m apart, all alike, with the views of their
 * faces. */
extern const struct surface reflector_models_usual_surface;

/* Refuses a surface without a contour, one of full_rad and zero_rad without the other, and a
 * zero_rad that is less. */
int reflector_models_check_surface(const struct surface *surface, const struct contour *contour,
                                   struct diag *diag);

/* The surface with the members of `over` in place of its own where they are stated. */
struct surface reflector_models_surface(const struct surface *surface, const struct surface *over);

/* Does every body have scatterers of its own? */
bool reflector_models_differs(const struct surface *surface);

/* Replaces the set's points, planes and rows by four rows of equal posts, no farther apart than the
 * surface's spacing on an object of this size; mirrors and whether the object blocks stay. The
 * sizes are at least 0.01 m and the spacing 0.02 m. */
void reflector_models_of_contour(const struct contour *contour, const struct surface *surface,
                                 struct vec2 size_m, struct reflector_set *set,
                                 struct arena *arena);

/* The same with points in place of the posts, each with a facing, a level and a height of its own,
 * which are drawn at the body's address. They are no farther apart than the spacing on a body of
 * size_m. On one of height_m > 0 they lie evenly over the height, each as high as the spacing. A
 * metre of a face has the power that it has on an object of usual_m, the class's size. */
void reflector_models_of_surface(const struct contour *contour, const struct surface *surface,
                                 struct vec2 usual_m, struct vec2 size_m, double height_m,
                                 const struct random_address *body, struct reflector_set *set,
                                 struct arena *arena);

/* Sensing targets of 3GPP TR 38.901, 7.9.2 (MODEL 2.8). A vehicle has five scattering points, each
 * in the middle of a face, with a lobe and a floor that is seen from everywhere; a human has one.
 * The cross sections are means over the report's log-normal fluctuation of 3.41 and 3.94 dB, which
 * a sensor's `fluctuation` adds. */
enum sensing_target_3gpp {
    SENSING_TARGET_3GPP_NONE,
    SENSING_TARGET_3GPP_VEHICLE,
    SENSING_TARGET_3GPP_HUMAN
};
extern const char *const reflector_models_3gpp_names[]; /* ending with NULL */

/* Replaces the set's points, planes and rows by the target's points; mirrors and whether the object
 * blocks stay. Not for SENSING_TARGET_3GPP_NONE. */
void reflector_models_of_3gpp(enum sensing_target_3gpp target, struct reflector_set *set,
                              struct arena *arena);
