#include "geometry/sensor_pose.h"

struct sensor_pose sensor_pose_on(const struct motion *ego, double mount_x_m, double mount_y_m,
                                  double mount_yaw_rad)
{
    struct vec2 heading = vec2_heading(ego->yaw_rad);
    struct vec2 mount_m = vec2_turn((struct vec2){mount_x_m, mount_y_m}, heading);
    struct vec2 position_m = vec2_add(ego->position_m, mount_m);
    return (struct sensor_pose){
        .position_m = position_m,
        .velocity_mps = motion_velocity_at(ego, position_m),
        .boresight = vec2_turn(vec2_heading(mount_yaw_rad), heading),
        .yaw_rad = ego->yaw_rad + mount_yaw_rad,
    };
}
