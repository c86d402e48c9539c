/* The surroundings of one sensor at the instant of measurement.
 *
 * The ego and all objects are moved to that instant in closed form; the sensor's place and velocity
 * follow from its mount on the moving, turning ego (MODEL 2.4). line_of_sight.h answers what lies
 * between two places of a look, direct_echoes.h and ghost_echoes.h make the echoes.
 *
 * A sensor with mount_z_m sees a reflector that has a height from its own height (MODEL 14.2): the
 * slant range, the range rate along the slant and the azimuth that a linear array reads are
 * compared with the sensor's limits and reported. Objects then hide only what is not seen over them
 * (MODEL 14.3); an object without a height hides all behind it. */
#pragma once

#include "documents/suite.h"
#include "frame/frame.h"
#include "geometry/kinematics.h"
#include "geometry/silhouette.h"

/* A reflector set of the frame, and the bodies that have its reflectors. */
struct look_set {
    const struct reflector_set *reflectors;
    const struct reflectors_shape *shape;
    struct look_body **bodies; /* those of reflectors->objects, in that order */
};

/* The directions from the sensor that a body, its shadow or its reflectors cover. */
struct look_extent {
    struct silhouette silhouette;
    struct silhouette_span span; /* the silhouette's sectors */
};

/* An object at the instant of measurement. */
struct look_body {
    const struct object *object;
    const struct look_set *set; /* NULL: no reflectors are described for it */
    struct box box;
    struct vec2 corner[4];
    double radius_m;           /* of the circle around the box */
    struct vec2 sensor_m;      /* the sensor's place in the body's frame */
    struct look_extent shadow; /* where the box and its rim may change what passes */
    bool blocks;               /* does its outline stop sight lines? */
    bool spare;                /* do enough other bodies block just as it does? */
    size_t twins;              /* bodies after it, by id, that block just as it does */
    bool raised;               /* can a radar look under it? */
    bool moved;                /* between the measurement and the frame's time */
};

struct look {
    struct frame *frame;
    const struct sensor *sensor;
    const struct selection *selection;
    double time_s; /* of the measurement */
    struct sensor_pose pose;
    double height_m;          /* the sensor's over the road; 0: in a flat world */
    bool sees_over;           /* may the sensor see over tops? */
    double wavelength_m;      /* of waves that bend around edges; 0: there is no diffraction */
    double rim_m;             /* so far beside a body, diffraction may change what passes */
    bool ego_moved;           /* between the measurement and the frame's time */
    struct vec2 view_right;   /* directions between these two may be in view, at low elevations; */
    struct vec2 view_left;    /* both zero: all directions */
    struct look_body *bodies; /* all objects but the ego, by id */
    size_t body_count;
    struct look_set *sets;                 /* of the frame, in its order */
    struct silhouette_index blocker_index; /* of the bodies that block, numbered as in indexed */
    const struct look_body **indexed;      /* by id */
    size_t indexed_count;
    const struct look_body **blockers; /* those that may hide the body at hand, by id */
    size_t blocker_count;
    int64_t pairs, echoes;      /* reflectors tried and direct echoes made so far */
    struct sighting *sightings; /* of the bodies, in their order; NULL: none are asked for */
};

/* Sets up a look for a measurement at time_s. The frame must have reflectors, and objects with the
 * ego among them. Fails if a reflector set lists the ego, or an object that the frame does not
 * have. */
int look_begin(struct look *look, struct frame *frame, const struct sensor *sensor,
               const struct selection *selection, double time_s, struct diag *diag);

/* The height over the road of a reflector at the fraction z of the body's height; the sensor's
 * height for z = 0. */
double look_reflector_height_m(const struct look *look, const struct look_body *body, double z);

/* The height up to which a body hides what is behind it; INFINITY if nothing is seen over it. */
double look_top_m(const struct look *look, const struct look_body *body);

/* What the sensor reads of a reflector at reflector_m over the road, whose kinematics in the plane
 * are given (MODEL 14.2). Sets gain to the beam's factor on amplitude at that elevation, and adds
 * elevation to effects if it changes anything. */
struct kinematics look_slant(const struct look *look, double reflector_m, struct kinematics plane,
                             double *gain, uint64_t *effects);

/* The ERCS of a flat side at its specular point, range_m away in the plane (MODEL 14.5). Adds
 * curvature to effects if it changes the value. */
double look_plane_ercs(const struct look *look, const struct plane_reflector *plane, double range_m,
                       uint64_t *effects);

/* Radius of a circle around the body's centre that holds all its reflectors and mirrors of the set.
 */
double look_reflectors_radius_m(const struct look_body *body, const struct look_set *set);

/* Extent of all reflectors and mirrors of the set on a body. */
struct look_extent look_reflectors_extent(const struct look *look, const struct look_body *body,
                                          const struct look_set *set);

/* True only if nothing within the silhouette can be in range, or in view at low elevations. */
bool look_out_of_range(const struct look *look, const struct silhouette *silhouette);
bool look_out_of_view(const struct look *look, const struct silhouette *silhouette);

/* True only if nothing of the body within the silhouette can be in range and in view. */
bool look_out_of_reach(const struct look *look, const struct look_body *body,
                       const struct silhouette *silhouette);

/* The factor on a point's ERCS for a viewer, the sensor itself or a bounce on the way to it: its
 * visibility (MODEL 2.2), times its lobe (MODEL 2.8) at the sensor's elevation. facing is the
 * heading of the point's facing_rad in the body's frame. 1 if visibility is not selected. */
double look_visibility(const struct look *look, const struct look_body *body,
                       const struct point_reflector *point, struct vec2 facing, struct vec2 place,
                       struct vec2 viewer);

/* Post number `post` of a row, as a point with its own name. */
struct point_reflector look_post(const struct look *look, const struct post_row *row, int64_t post);

/* EFFECT_BIT of latency if the ego or the body moved between the measurement and the frame's time,
 * else 0. */
uint64_t look_latency_effect(const struct look *look, const struct look_body *body);
