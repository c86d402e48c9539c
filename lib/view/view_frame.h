/* Places of sensors, targets and objects in a frame's view. Sensors are placed at the instant of
 * their measurement. Boxes without a size, as in streams that no glint-extract has seen, take that
 * of their class's vehicle document. */
#pragma once

#include "documents/vehicle_set.h"
#include "frame/frame.h"
#include "geometry/kinematics.h"

/* A sensor at the instant of its measurement, in the frame's coordinates. */
struct view_scan {
    struct sensor_pose pose;
    double age_s; /* the frame's time less that of the measurement */
};

/* The ego's motion, age_s before the time of the frame. Without objects in the stream it is at the
 * origin, heads along x, and its velocity is unknown (NAN). */
struct motion view_frame_ego(const struct frame *frame, double age_s);

struct view_scan view_frame_scan(const struct frame *frame, const struct sensor_view *sensor);

/* The place, in the frame's coordinates, at a range and an azimuth of a scan. */
struct vec2 view_frame_place(const struct view_scan *scan, double range_m, double azimuth_rad);

/* The object's box at the frame's time. A size of 0 is replaced by the class's, if vehicle is not
 * NULL. */
struct box view_frame_box(const struct object *object, const struct vehicle *vehicle);

/* False for losses by geometry, which are the rule and need no mark: facing away, no specular
 * point, out of range or view, switched off. True for the others and for LOSS_OWN. */
bool view_frame_loss_is_notable(enum loss reason);

/* Vehicle documents by class and digest, each looked up once; all memory is the arena's. */
struct view_model {
    const char *class;
    const struct vehicle *vehicle; /* NULL: the class has no document */
};

struct view_models {
    struct arena *arena;
    const char *folder; /* of vehicle documents, before all others; NULL: none */
    LIST_OF(struct view_model) list;
};

/* The class's document with this digest, where there is one; NULL: any document. */
const struct vehicle *view_frame_vehicle(struct view_models *models, const char *class,
                                         const char *digest);

/* Refuses a frame whose reflectors are those of other vehicle documents (DIAG_CONFIG): they would
 * be drawn where they are not. */
int view_frame_check_vehicles(struct view_models *models, const struct frame *frame,
                              struct diag *diag);
