/* Place, velocity and boresight of a sensor on the ego.
 *
 * The mount is given from the centre of the ego's box, in the ego's own frame. The pose has the
 * coordinates of the ego's motion (MODEL 2.4). */
#pragma once

#include "geometry/motion.h"

struct sensor_pose {
    struct vec2 position_m;
    struct vec2 velocity_mps; /* includes what the ego's turn rate adds at the mount */
    struct vec2 boresight;    /* unit vector */
    double yaw_rad;           /* of the boresight, not wrapped */
};

struct sensor_pose sensor_pose_on(const struct motion *ego, double mount_x_m, double mount_y_m,
                                  double mount_yaw_rad);
