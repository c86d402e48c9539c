/* Rigid motion of bodies, and places on their boxes. Motion is in closed form (MODEL 2.4): a body
 * moves with constant turn rate and constant acceleration along its path (a segment of a scenario),
 * or without acceleration, as when an object is moved to the instant of a measurement. Small turn
 * rates need no branch and no division by omega. */
#pragma once

#include "base/vec2.h"

/* The velocity is that of position_m; it need not point along the yaw (crabbing is allowed) and
 * turns with yaw_rate_radps. */
struct motion {
    struct vec2 position_m;
    struct vec2 velocity_mps;
    double yaw_rad;
    double yaw_rate_radps;
};

/* A body that drove for duration_s from position_m along its yaw, with speed_mps at the start and
 * constant acceleration and turn rate. A negative speed drives backwards; a deceleration that
 * outlasts the speed reverses the body. The result's yaw is not wrapped. */
struct motion motion_drive(struct vec2 position_m, double yaw_rad, double speed_mps,
                           double acceleration_mps2, double yaw_rate_radps, double duration_s);

/* The length of the path of motion_drive; driving backwards adds to it. Never negative. */
double motion_drive_length_m(double speed_mps, double acceleration_mps2, double duration_s);

/* The body after duration_s (negative: before) at constant speed and turn rate. */
struct motion motion_after(struct motion body, double duration_s);

/* The velocity of the body's material at place, in world coordinates: v + omega × r. */
struct vec2 motion_velocity_at(const struct motion *body, struct vec2 place);

/* A cubic Hermite span between two timed waypoints, with the given velocities at its ends:
 * position, velocity and acceleration at the fraction s in [0, 1] of duration_s. */
void motion_hermite(struct vec2 from_m, struct vec2 from_mps, struct vec2 to_m, struct vec2 to_mps,
                    double duration_s, double s, struct vec2 *position_m, struct vec2 *velocity_mps,
                    struct vec2 *acceleration_mps2);

/* The share, from 0 to 1, of the speeds at both ends with which a cubic Hermite span on a line
 * never runs backward (Fritsch and Carlson 1980); 1 if it does not anyway. No speed is negative. */
double motion_monotone_share(double from_mps, double to_mps, double mean_mps);

/* A body's box. Fractions (x, y) are of its length and width from its centre: x forward, y left, so
 * 0.5 is the front or the left side. They may lie beyond the box. */
struct box {
    struct motion motion; /* of the centre */
    struct vec2 heading;  /* unit vector along the length: that of the motion's yaw */
    double length_m, width_m;
};

/* The place in the world of a point in fractions of the box. */
static inline struct vec2 motion_box_place(const struct box *box, double x, double y)
{
    struct vec2 own = {x * box->length_m, y * box->width_m};
    return vec2_add(box->motion.position_m, vec2_turn(own, box->heading));
}

/* The four corners, counter-clockwise from the front left. */
void motion_box_outline(const struct box *box, struct vec2 corner[4]);

/* The unit vector from one place to another, both in fractions and not equal. Along a side of the
 * box it is exactly the heading or perpendicular to it, so that walls in line with equal yaw have
 * the same vector. */
struct vec2 motion_box_along(const struct box *box, double from_x, double from_y, double to_x,
                             double to_y);
