/* Straight pieces and arcs of a lane.
 *
 * At a corner of the line by the angle theta an arc touches both legs at the distance
 * R tan(theta / 2) from the corner, at most half a leg, so that neighbours have room. A lane's arc
 * has the same centre. Heading is continuous, and the yaw rate is speed times curvature. */
#pragma once

#include "geometry/motion.h"
#include "traffic/road.h"

struct lane_piece {
    double from_m; /* along the lane */
    struct vec2 begin_m;
    double yaw_rad; /* at its begin */
    double curvature_radpm;
};

struct lane_path {
    LIST_OF(struct lane_piece) pieces;
    double length_m;
    double radius_m; /* of its narrowest arc; INFINITY if it has none */
};

/* The way of a lane of the road, in the arena. Refuses arcs of less than 3 m. */
int lane_path_make(struct lane_path *path, const struct roadway *road, const struct road_lane *lane,
                   struct arena *arena, struct diag *diag);

/* A body at place_m along the lane; the first and the last piece go on beyond the ends. The yaw is
 * in (-pi, pi]. */
struct motion lane_path_motion(const struct lane_path *path, double place_m, double speed_mps);
