/* What a road user is to a radar: reflection centres on its outline (MODEL 2).
 *
 * A vehicle document in data/vehicles/ describes one class; glint-extract writes it as a set
 * that lists the objects of that class. Positions are fractions of the object's length and width
 * from the centre of its box (x forward, y left; 0.5 is the front and the left side), and of its
 * height from the road (z), so one set serves cars of any size. */
#ifndef REFLECTORS_H
#define REFLECTORS_H

#include "geometry/box.h"
#include "geometry/lobe.h"
#include "geometry/visibility_range.h"
#include "text/field.h"

/* What of an object moves on its own where a point is. */
enum moving_part { MOVING_NONE, MOVING_WHEEL, MOVING_LIMBS };
extern const char *const reflectors_moving_parts[]; /* their names, ending with NULL */

/* A corner, a wheel house, a pole: seen from a range of angles around its facing. */
struct point_reflector {
    const char *name;
    double x, y;
    double z;       /* 0: at the sensor's height */
    double extent;  /* from its lowest to its highest part, as a fraction of the height */
    double inset_m; /* the point lies this far inside, against its facing */
    double facing_rad;
    double full_rad, zero_rad;
    enum visibility_shape shape;
    double ercs;
    enum moving_part moving_part;
    double under_vehicles; /* the part of its ERCS that passes under a raised vehicle in the way */
    struct lobe lobe;      /* of what it returns, besides where it is seen from */
};

/* A flat side: mirrors the radar from the foot of the perpendicular, with constant ERCS, or, of a
 * side that is curved, with that of its specular point (curved_surface.h) if the sensor asks for
 * it. Its outer face is to the right of from -> to, that is, sides run counter-clockwise around the
 * outline. */
struct plane_reflector {
    const char *name;
    double from_x, from_y, to_x, to_y;
    double z, extent;
    double margin_m;
    double ercs;
    double profile_radius_m, radius_m; /* of curvature, upright and in the plane; 0: none */
};

/* A flat side that mirrors what stands before its outer face, for sensors that see ghosts
 * (ghost_echoes.h). It is no reflector itself: a side that is both is described twice. */
struct mirror_plane {
    double from_x, from_y, to_x, to_y; /* as a plane_reflector's */
    double reflection;                 /* amplitude reflection coefficient |Gamma| */
};

/* Equal points along a line: the posts of a guardrail, the first at from. Post n is called name_n.
 * Only the posts within a sensor's range are ever made. */
struct post_row {
    const char *name;
    double from_x, from_y, to_x, to_y;
    double z, extent;
    double spacing_m;
    double facing_rad;
    double full_rad, zero_rad;
    enum visibility_shape shape;
    double ercs;
};

struct reflector_set {
    const char *model;             /* the class that the document describes */
    LIST_OF(const char *) objects; /* their ids */
    bool blocks;                   /* does its outline stop sight lines? */
    bool raised;                   /* can a radar look under it? (MODEL 2.5, the option) */
    LIST_OF(struct point_reflector) points;
    LIST_OF(struct plane_reflector) planes;
    LIST_OF(struct post_row) rows;
    LIST_OF(struct mirror_plane) mirrors;
    const struct reflector_set *document; /* that it was copied from; NULL: none */
    const struct reflectors_shape *shape; /* the document's; NULL: of no document */
};

/* What follows from a set's lists alone. Its reflectors lie within an object's box, or, if any
 * stands out of it, within one that is larger by a share, and inset_m beyond. */
struct reflectors_shape {
    struct reflectors_face *faces; /* of its points */
    double share;                  /* at least 1 */
    double inset_m;
    bool under; /* may any of its points be seen under raised vehicles? */
};

/* Which way a point faces, in the object's frame. */
struct reflectors_face {
    struct vec2 heading;
    double dark_cosine; /* visibility_range.h */
};

extern const struct record point_record, plane_record, row_record;
extern const struct record reflector_set_record;   /* with its objects: the frame's */
extern const struct record reflector_model_record; /* without: the vehicle document's */

/* Are all of its lists still those of its document, which was checked when it was read? */
bool reflectors_unchanged(const struct reflector_set *set);

/* The first name that two reflectors of the set share, or NULL. Beside a row "a" no point or plane
 * may be called a_1, as posts are. */
const char *reflectors_name_twice(const struct reflector_set *set, struct arena *arena);

/* Worked out, or that of a document whose lists the set still has; in the arena. */
const struct reflectors_shape *reflectors_shape(const struct reflector_set *set,
                                                struct arena *arena);

/* A point with its inset. */
struct vec2 reflectors_point_place(const struct box *box, const struct point_reflector *point);

/* V(alpha) of MODEL 2.2: how much of a point at place a sensor sees; facing is the heading of the
 * point's facing_rad, in the object's frame. */
double reflectors_visibility(const struct box *box, const struct point_reflector *point,
                             struct vec2 facing, struct vec2 place, struct vec2 sensor);

/* Far more than the rounding of a place in the world. */
#define REFLECTORS_PLAIN_M 1e-6

/* True only if a sensor sees nothing of a point, and a plane has no specular point for it: told in
 * the object's frame, where sensor is its place, so that neither need be placed in the world. */
static inline bool reflectors_plainly_away(const struct box *box,
                                           const struct point_reflector *point,
                                           const struct reflectors_face *face, struct vec2 sensor)
{
    struct vec2 facing = face->heading;
    struct vec2 sight = {sensor.x - point->x * box->length_m + point->inset_m * facing.x,
                         sensor.y - point->y * box->width_m + point->inset_m * facing.y};
    return visibility_range_surely_zero(face->dark_cosine, facing, sight, REFLECTORS_PLAIN_M);
}
bool reflectors_plainly_aside(const struct box *box, const struct plane_reflector *plane,
                              struct vec2 sensor);

/* The factor on amplitude of a point's lobe; 1 without one. zenith_rad is the sensor's as the point
 * sees it. */
double reflectors_lobe(const struct box *box, const struct point_reflector *point,
                       struct vec2 place, struct vec2 sensor, double zenith_rad);

/* The numbers [first, end) of a row's posts that may lie within range_m of the sensor: none is
 * missed, and at most two too many are named. Place of post n by reflectors_post_place. */
void reflectors_posts_within(const struct box *box, const struct post_row *row, struct vec2 sensor,
                             double range_m, int64_t *first, int64_t *end);
struct vec2 reflectors_post_place(const struct box *box, const struct post_row *row, int64_t post);

#endif
