/* Scenarios of data/scenarios/: objects and how each one moves.
 *
 * An object with segments drives them one after another from its start pose, each with constant
 * acceleration and turn rate. After the last segment, or without any, it keeps speed and heading.
 * An object with waypoints follows a smooth curve through them (cubic Hermite, velocities at the
 * waypoints by finite differences, zero next to two equal places) and points along its velocity;
 * before the first and after the last waypoint it stands. Poses are exact functions of time, so no
 * error accumulates. */
#pragma once

#include "base/random.h"
#include "frame/frame.h"
#include "geometry/motion.h"
#include "traffic/road.h"

struct segment {
    double duration_s;
    double acceleration_mps2;
    double yaw_rate_radps;
};

struct waypoint {
    double time_s;
    double x_m, y_m;
};

struct actor {
    const char *id;
    const char *class;
    double length_m, width_m, height_m;
    double x_m, y_m, yaw_rad;
    double speed_mps;
    LIST_OF(struct segment) segments;
    LIST_OF(struct waypoint) waypoints;
};

struct scenario {
    const char *origin;
    const char *ego;
    double rate_hz;
    double duration_s;
    struct conditions conditions;
    LIST_OF(struct roadside_strip) roadside;
    LIST_OF(struct actor) objects;
    LIST_OF(struct roadway) roads; /* lib/traffic/road_traffic.h */
    double warmup_s;
    const char *arriving_ego; /* id of the ego if arrivals have ego_m; else NULL */
    struct vec2 origin_m;     /* of the frames' coordinates in those of the document */
};

extern const struct record scenario_record;

/* Refuses an unknown ego or interferer, an id of two objects or roads, a name that cannot be a
 * class, segments or a start together with waypoints, and waypoints whose times do not ascend. */
int scenario_check(struct scenario *scenario, struct diag *diag);

/* Moves every place by -origin_m, before anything is computed: large coordinates cost precision. */
void scenario_shift(struct scenario *scenario, struct vec2 origin_m);

/* The actor at time_s >= 0, its yaw in (-pi, pi], and the length of its path since time 0. A
 * standing object with waypoints points along its next motion, else its last one, else along
 * yaw_rad. */
struct motion scenario_motion(const struct actor *actor, double time_s, double *travelled_m);

/* The number of frames, and the time i / rate_hz of frame i, from 0. But for rounding the last
 * frame is not after duration_s. */
int64_t scenario_frames(const struct scenario *scenario);
double scenario_time_s(const struct scenario *scenario, int64_t number);

/* The object of this id; NULL if there is none. */
const struct actor *scenario_object(const struct scenario *scenario, const char *id);

/* The document of a scenario, whose values may be distributions (document_draw). */
struct scenario_document {
    const char *path;
    const char *line;
};

/* Finds and reads the document of this name or path. */
int scenario_read(const char *name, struct scenario_document *document, struct arena *arena,
                  struct diag *diag);

/* A scene of the document: drawn at the address, checked, and shifted to the origin of its frames.
 * ego replaces the scenario's own unless it is NULL. NULL after a message (DIAG_CONFIG). */
struct scenario *scenario_draw(const struct scenario_document *document,
                               struct random_address address, const char *ego, struct arena *arena,
                               struct diag *diag);

/* The origin of frames with an ego that begins here: whole metres near it if it is more than 1 km
 * from the origin of the source (as in UTM), else that origin. */
struct vec2 scenario_frame_origin(struct vec2 ego_m);

/* Fills time, interval, origin, conditions and the scenario's objects of frame `number`. */
void scenario_fill(const struct scenario *scenario, int64_t number, struct frame *frame);

/* Refuses a frame with an object out of the bounds of its record, for instance too far from the
 * origin (DIAG_CONFIG). The message names its id and the frame. */
int scenario_check_frame(const struct frame *frame, struct diag *diag);
