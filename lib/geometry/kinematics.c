#include "geometry/kinematics.h"

#include "base/elementary.h"
#include "base/units.h"

#define LN_2 0.693147180559945309417

struct sensor_pose kinematics_sensor_pose(const struct motion *ego, double mount_x_m,
                                          double mount_y_m, double mount_yaw_rad)
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

struct kinematics kinematics_of(struct vec2 sensor_m, struct vec2 sensor_mps, struct vec2 boresight,
                                struct vec2 point_m, struct vec2 point_mps)
{
    struct vec2 line_m = vec2_sub(point_m, sensor_m);
    double range_m = vec2_length(line_m);
    if (range_m == 0)
        return (struct kinematics){0};
    double azimuth_rad =
        elementary_atan2(vec2_cross(boresight, line_m), vec2_dot(boresight, line_m));
    return (struct kinematics){
        .range_m = range_m,
        .azimuth_rad = azimuth_rad <= -PI ? PI : azimuth_rad,
        .range_rate_mps = vec2_dot_accurate(vec2_sub(point_mps, sensor_mps), line_m) / range_m,
    };
}

struct slant kinematics_slant(double distance_m, double height_m)
{
    double range_m = elementary_hypot(distance_m, height_m);
    if (range_m == 0)
        return (struct slant){0, 0, 1};
    return (struct slant){range_m, height_m / range_m, distance_m / range_m};
}

double kinematics_slant_azimuth_rad(struct slant elevation, double azimuth_rad)
{
    if (elevation.sine == 0)
        return azimuth_rad;
    struct elementary_sincos azimuth = elementary_sincos(azimuth_rad);
    double along = elementary_hypot(azimuth.cos, azimuth.sin * elevation.sine);
    return elementary_atan2(azimuth.sin * elevation.cosine, copysign(along, azimuth.cos));
}

double kinematics_slant_amplitude_factor(struct slant elevation, double half_width_rad)
{
    double widths = elementary_atan2(elevation.sine, elevation.cosine) / half_width_rad;
    return elementary_exp(-LN_2 * widths * widths);
}
