/* Reflection centres of a class of road users (MODEL 2).
 *
 * A vehicle document in data/vehicles/ describes one class; glint-extract writes it as a set that
 * lists the objects of that class. One set serves objects of any size: x and y are fractions of an
 * object's length and width from the centre of its box (motion.h), z is a fraction of its height
 * from the road. */
#pragma once

#include "geometry/directivity.h"
#include "geometry/motion.h"
#include "propagation/reflection.h"
#include "text/field.h"

struct list_cache;

/* The part of an object at a point that moves against the body. */
enum moving_part { MOVING_NONE, MOVING_WHEEL, MOVING_LIMBS };
extern const char *const reflectors_moving_parts[]; /* names on the wire, ending with NULL */

/* A corner, a wheel house, a pole: a point that is seen from angles around its facing. */
struct point_reflector {
    const char *name;
    double x, y;
    double z;       /* 0: at the sensor's height */
    double extent;  /* from its lowest to its highest part, as a fraction of the object's height */
    double inset_m; /* distance of the point behind (x, y), against its facing */
    double facing_rad;
    double full_rad, zero_rad; /* directivity.h */
    enum visibility_shape shape;
    double ercs;
    enum moving_part moving_part;
    double under_vehicles; /* share of the ERCS that is left if only raised vehicles block it */
    struct lobe lobe;      /* a factor on ERCS besides visibility */
};

/* A flat side, which mirrors the radar's wave back from the foot of the perpendicular. Its ERCS is
 * constant, or, for a sensor with curved_sides, that of its curvature (reflection.h). Its outer
 * face is to the right of from -> to: sides run counter-clockwise around the outline. */
struct plane_reflector {
    const char *name;
    double from_x, from_y, to_x, to_y;
    double z, extent;
    double margin_m; /* a foot nearer to an end than this is none */
    double ercs;
    double profile_radius_m, radius_m; /* of curvature, upright and in the plane; 0: straight */
};

/* A side that mirrors objects before its outer face, for sensors that see ghosts (ghost_echoes.h).
 * It is no reflector itself: a side that is both is listed as both. */
struct mirror_plane {
    double from_x, from_y, to_x, to_y; /* as a plane_reflector's */
    double reflection;      /* amplitude reflection coefficient |Gamma|; 0: that of the material */
    enum material material; /* MATERIAL_NONE: reflection is constant */
    double profile_radius_m, radius_m; /* of curvature, upright and in the plane; 0: straight */
    double bottom;                     /* lower edge, as a fraction of the object's height */
};

/* Equal points along a line, such as the posts of a guardrail. The first, number 0, is at from;
 * post n has the name name_n. */
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

/* All reflectors of a class, and the objects that have them. */
struct reflector_set {
    const char *model;             /* the class */
    LIST_OF(const char *) objects; /* ids */
    bool blocks;                   /* do the objects' outlines stop sight lines? */
    bool raised;                   /* can a radar look under the objects? (MODEL 2.5) */
    double clearance_m;            /* of the objects' undersides above the road; 0: none */
    LIST_OF(struct point_reflector) points;
    LIST_OF(struct plane_reflector) planes;
    LIST_OF(struct post_row) rows;
    LIST_OF(struct mirror_plane) mirrors;
    const struct reflector_set *document; /* a checked set that had these lists, or NULL */
    const struct reflectors_shape *shape; /* the document's, or NULL */
};

/* Values by a set's lists. All reflectors and mirrors lie within share times an object's box, and
 * inset_m beyond. */
struct reflectors_shape {
    struct reflectors_face *faces; /* one for each point */
    double share;                  /* at least 1 */
    double inset_m;                /* the largest of its points */
    double lowest_z, highest_z;    /* of reflectors with a height; both 0 if none has */
    bool under;                    /* may any of its points be seen under raised vehicles? */
};

/* The direction in which a point faces, in the object's frame. */
struct reflectors_face {
    struct vec2 heading;
    double dark_cosine; /* directivity_dark_cosine */
};

extern const struct record reflector_set_record;   /* of a frame: with model and objects */
extern const struct record reflector_model_record; /* of a vehicle document: without these */

/* True if all lists of the set are those of its document, which was checked when it was loaded. */
bool reflectors_unchanged(const struct reflector_set *set);

/* Keeps a set that was checked, with its shape, as the document of sets with the same lists in
 * later lines. Does nothing unless the cache has all its lists. */
void reflectors_keep(const struct reflector_set *set, struct list_cache *cache);

/* Gives a set the document and the shape that were kept of its lists. False if there are none. */
bool reflectors_recall(struct reflector_set *set, struct list_cache *cache);

/* A name of two reflectors of the set, or NULL. The posts of a row "a" have the names a_0, a_1 and
 * so on, which no point or plane may have. */
const char *reflectors_name_twice(const struct reflector_set *set, struct arena *arena);

/* The number, from 0, of the first mirror that has both a material and a reflection, or neither;
 * the count of mirrors if there is none. */
size_t reflectors_unclear_mirror(const struct reflector_set *set);

/* The shape of a set: its document's if its lists are unchanged, else a new one in the arena. */
const struct reflectors_shape *reflectors_shape(const struct reflector_set *set,
                                                struct arena *arena);

/* The place of a point in the world, its inset included. */
struct vec2 reflectors_point_place(const struct box *box, const struct point_reflector *point);

/* The visibility V of MODEL 2.2 of a point at place for a sensor. facing is the heading of the
 * point's facing_rad in the object's frame. */
double reflectors_visibility(const struct box *box, const struct point_reflector *point,
                             struct vec2 facing, struct vec2 place, struct vec2 sensor);

/* Slack of such tests as the two below, far more than the rounding of a place in the world. */
#define REFLECTORS_SLACK_M 1e-6

/* True only if the visibility of a point is 0. sensor is the sensor's place in the object's frame,
 * so that the point need not be placed in the world. */
static inline bool reflectors_surely_unseen(const struct box *box,
                                            const struct point_reflector *point,
                                            const struct reflectors_face *face, struct vec2 sensor)
{
    struct vec2 facing = face->heading;
    struct vec2 sight = {sensor.x - point->x * box->length_m + point->inset_m * facing.x,
                         sensor.y - point->y * box->width_m + point->inset_m * facing.y};
    return directivity_surely_zero(face->dark_cosine, facing, sight, REFLECTORS_SLACK_M);
}

/* True only if a plane has no specular point for a sensor at that place in the object's frame. */
bool reflectors_surely_no_foot(const struct box *box, const struct plane_reflector *plane,
                               struct vec2 sensor);

/* The factor of a point's lobe on amplitude; 1 without a lobe. zenith_rad is the sensor's zenith
 * angle as seen from the point. */
double reflectors_lobe(const struct box *box, const struct point_reflector *point,
                       struct vec2 place, struct vec2 sensor, double zenith_rad);

/* The numbers [first, end) of all posts within range_m of the sensor, and of at most two others. */
void reflectors_posts_within(const struct box *box, const struct post_row *row, struct vec2 sensor,
                             double range_m, int64_t *first, int64_t *end);

/* Cuts the numbers [*first, *end) of posts to those of posts from first_m to end_m along the row,
 * and of one more on each side. */
void reflectors_cut_posts(const struct post_row *row, double first_m, double end_m, int64_t *first,
                          int64_t *end);

/* The name of post number `post` >= 0 of a row: that of the row, "_" and the number. */
const char *reflectors_post_name(const char *row, int64_t post, struct arena *arena);

/* The place of a post in the world. */
struct vec2 reflectors_post_place(const struct box *box, const struct post_row *row, int64_t post);
