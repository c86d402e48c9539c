/* The surroundings of one sensor at the instant of measurement.
 *
 * The ego and all objects are moved to that instant in closed form. The place and velocity of the
 * sensor follow from its mount on the moving, turning ego (MODEL 2.4).
 *
 * If both the sensor (mount_z_m) and a reflector have a height, the sensor measures the slant
 * range, the range rate along the slant, and the azimuth that a linear array measures; its limits
 * apply to these (MODEL 14.2). It then sees over objects that have a height; an object without a
 * height hides everything behind it (MODEL 14.3). */
#pragma once

#include "documents/suite.h"
#include "frame/frame.h"
#include "geometry/kinematics.h"
#include "geometry/obstruction.h"
#include "geometry/silhouette.h"

/* A reflector set of the frame, and the bodies that carry its reflectors. */
struct look_set {
    const struct reflector_set *reflectors;
    const struct reflectors_shape *shape;
    struct look_body **bodies; /* in the order of reflectors->objects */
};

/* The azimuths that a body, its shadow or its reflectors cover for the sensor. */
struct look_extent {
    struct silhouette silhouette;
    struct silhouette_span span; /* sectors of the silhouette */
};

/* An object at the instant of measurement. */
struct look_body {
    const struct object *object;
    const struct look_set *set; /* NULL: it has no reflectors */
    struct box box;
    struct vec2 corner[4];
    double radius_m;           /* of the circle around the box */
    struct vec2 sensor_m;      /* the sensor's place in the body's frame */
    struct look_extent shadow; /* of the box and its rim */
    bool blocks;               /* its outline stops sight lines */
    bool spare;                /* enough equal bodies precede it, so it need not be tested */
    size_t twins;              /* number of equal bodies after it, by id */
    bool raised;               /* a radar can look under it */
    bool moved;                /* between the measurement and the frame's time */
};

struct look {
    struct frame *frame;
    const struct sensor *sensor;
    const struct selection *selection;
    double time_s; /* of the measurement */
    struct sensor_pose pose;
    double height_m;          /* of the sensor over the road; 0: the scene is flat */
    bool sees_over;           /* the sensor may see over objects and under them */
    bool sees_under;          /* sees_over, and a class of the frame has a clearance */
    double wavelength_m;      /* for diffraction; 0: none is simulated */
    double rim_m;             /* width of the zone beside a body where diffraction is felt */
    bool ego_moved;           /* between the measurement and the frame's time */
    struct vec2 view_right;   /* right border of the field of view at low elevations */
    struct vec2 view_left;    /* left border; both zero: all directions may be in view */
    struct look_body *bodies; /* all objects but the ego, by id */
    size_t body_count;
    struct look_set *sets;                 /* in the frame's order */
    struct silhouette_index blocker_index; /* finds places in indexed */
    const struct look_body **indexed;      /* the bodies that block, by id */
    size_t indexed_count;
    const struct look_body **blockers; /* the bodies that may hide the present one, by id */
    size_t blocker_count;
    int64_t pairs, echoes;      /* reflectors tried, and direct echoes made, so far */
    struct sighting *sightings; /* one for each body, in their order; NULL: not asked for */
};

/* Sets up a look for a measurement at time_s. The frame must have reflectors, and objects with the
 * ego among them. Fails if a reflector set lists the ego, or an object that the frame does not
 * have. */
int look_begin(struct look *look, struct frame *frame, const struct sensor *sensor,
               const struct selection *selection, double time_s, struct diag *diag);

/* Height over the road of a reflector at the fraction z of the body's height; z = 0 means unknown
 * and gives the sensor's height. */
double look_reflector_height_m(const struct look *look, const struct look_body *body, double z);

/* Heights between which a body hides what is behind it; a top of INFINITY if nothing is seen over
 * it, a bottom of 0 if nothing is seen under it. */
struct obstruction_heights look_heights(const struct look *look, const struct look_body *body);

/* Range, azimuth and range rate of a point in the plane. */
struct kinematics look_kinematics(const struct look *look, struct vec2 place, struct vec2 velocity);

/* Range, azimuth and range rate that the sensor measures of a reflector at reflector_m over the
 * road, from its kinematics in the plane (MODEL 14.2). Sets gain to the beam's factor on amplitude
 * at that elevation, and adds elevation to effects if it changes a value. */
struct kinematics look_slant(const struct look *look, double reflector_m, struct kinematics plane,
                             double *gain, uint64_t *effects);

/* Sets the elevation of an echo that arrives from a place at height_m over the road, if the sensor
 * measures it. */
void look_set_elevation(const struct look *look, struct vec2 place, double height_m,
                        struct echo *echo);

/* ERCS of a flat side at its specular point, range_m away in the plane (MODEL 14.5). Adds curvature
 * to effects if it changes the value. */
double look_plane_ercs(const struct look *look, const struct plane_reflector *plane, double range_m,
                       uint64_t *effects);

/* Extent of all reflectors and mirrors of the set on a body. */
struct look_extent look_reflectors_extent(const struct look *look, const struct look_body *body,
                                          const struct look_set *set);

/* Distances from the nearer end of the sensor's ranges and of its field of view; < 0 outside.
 * `read` has range and azimuth as they are measured. */
double look_within_range_m(const struct look *look, const struct kinematics *read);
double look_within_view_rad(const struct look *look, double azimuth_rad);

/* Margins whose sight_m is margin_m; no margins in a frame that carries none. */
struct margins look_sight_margins(const struct look *look, double margin_m);

/* True only if nothing within the silhouette can be in range, or in view at low elevations. */
bool look_out_of_range(const struct look *look, const struct silhouette *silhouette);
bool look_out_of_view(const struct look *look, const struct silhouette *silhouette);

/* The most that a reflector of the body's set is above or below the sensor. */
double look_rise_m(const struct look *look, const struct look_body *body,
                   const struct look_set *set);

/* True only if nothing within the silhouette that is at most rise_m above or below the sensor can
 * be in range and in view; the same for a disc and the view alone. */
bool look_out_of_reach(const struct look *look, double rise_m, const struct silhouette *silhouette);
bool look_disc_out_of_view(const struct look *look, double rise_m, struct vec2 centre,
                           double radius_m);

/* A part of a line: empty if first is above end. */
struct look_stretch {
    double first_m, end_m; /* along the line */
};

/* The part of a straight strip of this half width that holds all that may be in range and in view,
 * and is at most rise_m above or below the sensor. The strip runs endlessly both ways along the
 * unit vector heading; lengths along it count from the place `from`. */
struct look_stretch look_stretch_in_reach(const struct look *look, struct vec2 from,
                                          struct vec2 heading, double half_width_m, double rise_m);

/* Factor on a point's ERCS towards a viewer, which is the sensor or a bounce on the way to it: the
 * point's visibility (MODEL 2.2) times its lobe (MODEL 2.8) at the sensor's elevation. facing is
 * the unit vector at facing_rad in the body's frame. 1 if visibility is not selected. */
double look_visibility(const struct look *look, const struct look_body *body,
                       const struct point_reflector *point, struct vec2 facing, struct vec2 place,
                       struct vec2 viewer);

/* A post of a row as a point, without its name. */
struct point_reflector look_post(const struct post_row *row);

/* EFFECT_BIT of latency if the ego or the body moved between the measurement and the frame's time,
 * else 0. */
uint64_t look_latency_effect(const struct look *look, const struct look_body *body);
