/* One sensor's look at a scene: where it stands, what is there, and what a sensor at that place
 * reads of it (MODEL 2.4).
 *
 * A look stands at the instant of the measurement: the ego and all objects are moved there in
 * closed form, the sensor's place and speed follow from its mount on the moving, turning ego. What
 * lies in the way is in line_of_sight.h, what echoes in direct_echoes.h and ghost_echoes.h.
 *
 * With mount_z_m reflectors that have a height are seen from the sensor's: their slant range, the
 * angle that a linear array reads, and the rate along the slant decide and are reported (EFFECTS
 * 19), and objects hide what they are high enough for. An object without a height hides all. */
#ifndef LOOK_H
#define LOOK_H

#include "documents/suite.h"
#include "frame/frame.h"
#include "geometry/azimuth_index.h"
#include "geometry/kinematics.h"
#include "geometry/sensor_pose.h"

/* A reflector set of the frame, and the bodies that have its reflectors. */
struct look_set {
    const struct reflector_set *reflectors;
    const struct reflectors_shape *shape;
    struct look_body **bodies; /* those of reflectors->objects, in that order */
};

/* What of the view something covers. */
struct look_extent {
    struct silhouette silhouette;
    struct azimuth_index_span span; /* of it */
};

struct look_body {
    const struct object *object;
    const struct look_set *set; /* NULL: no reflectors are described for it */
    struct box box;
    struct vec2 corner[4];
    double radius_m;           /* of the circle around the box */
    struct vec2 sensor_m;      /* in the body's frame */
    struct look_extent shadow; /* of the box and where it bends what passes */
    bool blocks;
    bool raised;
    bool moved; /* between the instant of the measurement and the frame's time */
};

struct look {
    struct frame *frame;
    const struct sensor *sensor;
    const struct selection *selection;
    double time_s;
    struct sensor_pose pose;
    double height_m;          /* 0: in a flat world */
    bool over;                /* is something seen over what is low? */
    double wavelength_m;      /* that bends around edges; 0: none does */
    double bend_m;            /* how far beside a body it may matter that it does */
    bool moved;               /* the ego, since then */
    struct vec2 view_right;   /* what is not high above or below is in view from here */
    struct vec2 view_left;    /* to here; both zero: all around */
    struct look_body *bodies; /* all objects but the ego, by id */
    size_t body_count;
    struct look_set *sets;             /* of the frame */
    struct azimuth_index bearings;     /* of the bodies that block, as they are numbered here */
    const struct look_body **blockers; /* of the body that is looked at, by id */
    size_t blocker_count;
    int64_t pairs, echoes;
};

/* The frame must have objects (the ego among them) and reflectors. Refuses a reflector set that
 * lists an object that is not among them, or the ego. */
int look_begin(struct look *look, struct frame *frame, const struct sensor *sensor,
               const struct selection *selection, double time_s, struct diag *diag);

/* Of a reflector at a fraction of the object's height, or at the sensor's for z = 0. */
double look_height_m(const struct look *look, const struct look_body *body, double z);

/* The height over which a body is looked; INFINITY where nothing is. */
double look_top_m(const struct look *look, const struct look_body *body);

/* What a sensor reads of a reflector at that height which it would see so in the plane, with the
 * factor on amplitude of its beam; adds to effects. */
struct kinematics look_slant(const struct look *look, double reflector_m, struct kinematics sight,
                             double *gain, uint64_t *effects);

/* The cross section of a side at its specular point, range_m away in the plane; adds to effects. */
double look_plane_ercs(const struct look *look, const struct plane_reflector *plane, double range_m,
                       uint64_t *effects);

/* The circle around the body's centre with all reflectors of that set, and their extent. */
double look_reflectors_radius_m(const struct look_body *body, const struct look_set *set);
struct look_extent look_reflectors(const struct look *look, const struct look_body *body,
                                   const struct look_set *set);

/* True only if nothing of the body within that silhouette can be in range and in view. */
bool look_out_of_reach(const struct look *look, const struct look_body *body,
                       const struct silhouette *silhouette);

/* How much of a point is seen from the viewer, the sensor itself or a bounce on the way to it: its
 * visibility, and its lobe at the sensor's elevation. 1 without the effect visibility. */
double look_visibility(const struct look *look, const struct look_body *body,
                       const struct point_reflector *point, struct vec2 facing, struct vec2 place,
                       struct vec2 viewer);

/* A post of a row as the point it is, under its name. */
struct point_reflector look_post(const struct look *look, const struct post_row *row, int64_t post);

/* EFFECT_BIT of latency if it changes how the sensor sees this body, else 0. */
uint64_t look_latency_effect(const struct look *look, const struct look_body *body);

#endif
