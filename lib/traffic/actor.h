/* One object of a scenario, and how it moves.
 *
 * An object with segments drives them one after another from its start pose, each with constant
 * acceleration and turn rate. After the last segment, or without any, it keeps speed and heading.
 * An object with waypoints follows a smooth curve through them (cubic Hermite, velocities at the
 * waypoints by finite differences, zero next to two equal places) and points along its velocity;
 * before the first and after the last waypoint it stands. Poses are exact functions of time, so no
 * error accumulates. */
#pragma once

#include "geometry/motion.h"
#include "text/field.h"

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
    /* By actor_prepare, one of the two: */
    struct segment_begin *begins; /* of each segment, and of the time after the last one */
    struct span *spans;           /* one less than waypoints */
};

extern const struct record actor_record;

/* Refuses segments or a start together with waypoints, a single waypoint, and waypoints whose times
 * do not ascend. */
int actor_check(const struct actor *actor, struct diag *diag);

/* Moves every place by -origin_m. */
void actor_shift(struct actor *actor, struct vec2 origin_m);

/* Where the actor is at time 0. It need not be prepared. */
struct vec2 actor_start(const struct actor *actor);

/* Computes once what every later motion needs of the whole way: its places do not change any more.
 */
void actor_prepare(struct actor *actor, struct arena *arena);

/* The prepared actor at time_s >= 0, its yaw in (-pi, pi], and the length of its path since time 0.
 * A standing object with waypoints points along its next motion, else its last one, else along
 * yaw_rad. */
struct motion actor_motion(const struct actor *actor, double time_s, double *travelled_m);
