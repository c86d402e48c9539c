/* Hand-written scenarios: the objects and how each one moves. They are documents in
 * data/scenarios/.
 *
 * An object with segments drives them one after another from its start pose, each with constant
 * acceleration and turn rate; after the last it keeps its speed and heading. An object without
 * segments or waypoints keeps its start speed and heading, so it stands unless it has a speed. An
 * object with waypoints follows a smooth curve through them (cubic Hermite, velocities at the
 * waypoints by finite differences, zero next to two equal places) and points along its velocity;
 * before the first and after the last waypoint it stands there. Poses are exact functions of time:
 * nothing is stepped, so no error accumulates. */
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
    LIST_OF(struct actor) objects;
    LIST_OF(struct roadway) roads; /* lib/traffic/road_traffic.h */
    double warmup_s;
    const char *arriving_ego; /* id of the ego among arrivals; NULL: none of them says ego_m */
    struct vec2 origin_m;     /* of the frames' coordinates in those of the document */
};

extern const struct record scenario_record;

/* Refuses what field tables cannot: an unknown ego or interferer, an id of two objects or roads,
 * what cannot be a class, segments or a start together with waypoints, waypoints whose times do not
 * ascend. */
int scenario_check(struct scenario *scenario, struct diag *diag);

/* Moves every place by -origin_m. Done before anything is computed, so that large coordinates cost
 * no precision later. */
void scenario_shift(struct scenario *scenario, struct vec2 origin_m);

/* The actor at time_s >= 0, its yaw in (-pi, pi], and the length of its path since time 0. While an
 * object with waypoints stands, it points to where it goes next, else to where it last went, else
 * along yaw_rad. */
struct motion scenario_motion(const struct actor *actor, double time_s, double *travelled_m);

/* The number of frames; they are numbered from 0, and frame i is at i / rate_hz. But for rounding
 * the last is not after duration_s. */
int64_t scenario_frames(const struct scenario *scenario);
double scenario_time_s(const struct scenario *scenario, int64_t number);

/* The object of this id; NULL if there is none. */
const struct actor *scenario_object(const struct scenario *scenario, const char *id);

/* The document of a scenario, whose values may be distributions (document_draw). */
struct scenario_document {
    const char *path;
    const char *line;
};

/* Finds and reads the document of this name or path; it lies in the arena. */
int scenario_read(const char *name, struct scenario_document *document, struct arena *arena,
                  struct diag *diag);

/* A scene of the document, whose values are drawn at the address (document_draw), checked and
 * shifted to the origin of its frames. ego: in place of the scenario's own, unless NULL. All of it
 * lies in the arena; NULL after a message (DIAG_CONFIG). */
struct scenario *scenario_draw(const struct scenario_document *document,
                               struct random_address address, const char *ego, struct arena *arena,
                               struct diag *diag);

/* The origin of frames with an ego that begins here: in whole metres near it if it is more than a
 * kilometre away (as in UTM), else that of the source. */
struct vec2 scenario_frame_origin(struct vec2 ego_m);

/* Fills time, interval, origin, conditions and the scenario's own objects of frame number 0 <=
 * number < scenario_frames. */
void scenario_fill(const struct scenario *scenario, int64_t number, struct frame *frame);

/* Refuses a frame with an object out of the bounds of its record, for instance too far from the
 * origin or turning too fast (DIAG_CONFIG). The message names its id and the frame. */
int scenario_check_frame(const struct frame *frame, struct diag *diag);
