/* Recorded traffic: tables in the layout of the INTERACTION data set, one row per road user and
 * instant.
 *
 * Needed columns: track_id, timestamp_ms, agent_type, x, y, vx, vy, and then all or none of
 * psi_rad, length, width, which files of pedestrians lack; a row may leave its three cells empty.
 * Without them the yaw is the direction of the velocity, 0 if that is zero, and the sizes are 0.
 * Other columns are passed over. Coordinates may be large (UTM): the caller moves them. */
#ifndef TRAJECTORY_H
#define TRAJECTORY_H

#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/diag.h"

/* A road user at one instant. The yaw lies in (-pi, pi]; its rate is the difference to the track's
 * next state (for the last one, to the state before; 0 if there is no other); the way travelled
 * is that from the track's first state, place to place. */
struct recorded_state {
    int64_t time_ms;
    const char *id;
    const char *class;
    double x_m, y_m;
    double vx_mps, vy_mps;
    double yaw_rad, yaw_rate_radps;
    double length_m, width_m;
    double travelled_m;
    size_t row; /* in the file, for messages */
};

/* All that was recorded at one instant, ids ascending as text. */
struct recorded_step {
    int64_t time_ms;
    int64_t interval_ms; /* since the step before; for the first until the next; 0 if alone */
    const struct recorded_state *states;
    size_t count;
};

struct trajectories {
    const struct recorded_step *steps; /* times ascending */
    size_t step_count;
    const char *const *ids; /* of all tracks, ascending as text */
    size_t id_count;
};

/* The whole recording, in the arena. Messages name the row but not the file. */
int trajectory_read(const char *path, struct arena *arena, struct trajectories *trajectories,
                    struct diag *diag);

bool trajectory_has(const struct trajectories *trajectories, const char *id);

#endif
