/* Roads of a scenario: polylines with lanes, corners as arcs.
 *
 * At a corner of the line by the angle theta an arc touches both legs at the distance
 * R tan(theta / 2) from the corner, at most half a leg, so that neighbours have room. A lane's arc
 * has the same centre. Heading is continuous, and the yaw rate is speed times curvature. */
#pragma once

#include "geometry/motion.h"
#include "text/field.h"

struct road_point {
    double x_m, y_m;
};

struct road_signal {
    double at_m; /* along its lane */
    double green_s, red_s, offset_s;
};

/* Vehicles of a class that arrive independently of each other (Poisson). */
struct road_arrivals {
    const char *class;
    double flow_per_h;
    double length_m, width_m, height_m;
    double speed_mps; /* wanted where the limit is higher */
    double headway_s, gap_m, acceleration_mps2, deceleration_mps2;
    double spread;
    double ego_m; /* -1: none is the ego */
};

struct road_lane {
    double offset_m, limit_mps;
    bool oncoming;
    LIST_OF(struct road_arrivals) arrivals;
    LIST_OF(struct road_signal) signals;
};

struct roadway {
    const char *id;
    double radius_m; /* of the arcs at corners, at most */
    LIST_OF(struct road_point) points;
    LIST_OF(struct road_lane) lanes;
};

extern const struct record roadway_record;

/* Refuses fewer than two points, equal neighbouring points, no lane, and names that cannot be a
 * class. Adds to egos the number of arrivals with ego_m. */
int road_check(const struct roadway *road, int *egos, struct diag *diag);

/* Multiplies every flow. */
void road_scale_flow(struct roadway *road, double factor);

/* Moves every point by -origin_m. */
void road_shift(struct roadway *road, struct vec2 origin_m);

/* Straight pieces and arcs of a lane. */
struct road_piece {
    double from_m; /* along the lane */
    struct vec2 begin_m;
    double yaw_rad; /* at its begin */
    double curvature_radpm;
};

struct road_path {
    LIST_OF(struct road_piece) pieces;
    double length_m;
    double radius_m; /* of its narrowest arc; INFINITY if it has none */
};

/* The path of a lane, in the arena. Refuses arcs with a radius below 3 m. */
int road_path_make(struct road_path *path, const struct roadway *road, const struct road_lane *lane,
                   struct arena *arena, struct diag *diag);

/* A body at place_m along the lane, which goes on beyond its ends. The yaw is in (-pi, pi]. */
struct motion road_path_motion(const struct road_path *path, double place_m, double speed_mps);
