/* Recorded trajectories from tables in the INTERACTION data set's layout. A row is one road user at
 * one instant.
 *
 * Needed columns are track_id, timestamp_ms, agent_type, x, y, vx, vy. The columns psi_rad, length
 * and width come all or not at all: files of pedestrians lack them, and a row may leave its three
 * cells empty. Without them the yaw is the direction of the velocity, 0 if that is zero, and the
 * sizes are 0. Other columns are ignored. Coordinates may be large (UTM): the caller shifts
 * them. */
#ifndef TRAJECTORY_H
#define TRAJECTORY_H

#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/diag.h"

/* A road user at one instant. The yaw lies in (-pi, pi]. The yaw rate is the difference to the
 * track's next state, divided by the time between both; for the last state that of the one before,
 * 0 if there is no other. travelled_m adds up the straight distances from the track's first state
 * on. */
struct recorded_state {
    int64_t time_ms;
    const char *id;
    const char *class;
    double x_m, y_m;
    double vx_mps, vy_mps;
    double yaw_rad, yaw_rate_radps;
    double length_m, width_m;
    double travelled_m;
    size_t row; /* row in the file, for messages */
};

/* All states that were recorded at one instant, ids ascending as text. */
struct recorded_step {
    int64_t time_ms;
    int64_t interval_ms; /* since the step before; for the first step, until the next; 0 if there is
                          * only one */
    const struct recorded_state *states;
    size_t count;
};

struct trajectories {
    const struct recorded_step *steps; /* in ascending order of time */
    size_t step_count;
    const char *const *ids; /* ids of all tracks, ascending as text */
    size_t id_count;
};

/* Reads the whole recording into the arena. Messages name the row but not the file. */
int trajectory_read(const char *path, struct arena *arena, struct trajectories *trajectories,
                    struct diag *diag);

bool trajectory_has(const struct trajectories *trajectories, const char *id);

#endif
