/* Rigid motion in the plane in closed form: constant acceleration along the path and constant turn
 * rate (a segment of a scenario), and the same without acceleration, which is how later stages
 * move objects back to the instant of a measurement.
 *
 * With h = omega t / 2, the displacement is, in the frame of the heading at half time,
 *     t ( (v + a t/2) si(h),  (a t/2) j1(h) ),    si(h) = sin h / h,  j1(h) = (si h - cos h) / h,
 * which has no small-omega branch to get wrong (NUMERICS 37): si and j1 are smooth at 0. */
#ifndef MOTION_H
#define MOTION_H

#include "base/vec2.h"

/* Velocity is that of the position; it need not point along the yaw (crabbing is allowed) and
 * turns with yaw_rate_radps. */
struct motion {
    struct vec2 position_m;
    struct vec2 velocity_mps;
    double yaw_rad;
    double yaw_rate_radps;
};

/* Where a body driving along its yaw at speed_mps is after duration_s of constant acceleration and
 * turn rate, from position_m and yaw_rad. A speed below zero drives backwards; a deceleration that
 * outlasts the speed reverses the body. The result's yaw is not wrapped. */
struct motion motion_drive(struct vec2 position_m, double yaw_rad, double speed_mps,
                           double acceleration_mps2, double yaw_rate_radps, double duration_s);

/* The length of the path in motion_drive: reversing counts forward. Never negative. */
double motion_drive_length_m(double speed_mps, double acceleration_mps2, double duration_s);

/* The body after duration_s (negative: before) at constant speed and turn rate. */
struct motion motion_after(struct motion body, double duration_s);

/* The velocity of the material point of the body at place (world coordinates): v + omega × r. */
struct vec2 motion_velocity_at(const struct motion *body, struct vec2 place);

/* A cubic Hermite span between two timed waypoints at fraction s in [0, 1] of duration_s, with the
 * given velocities at its ends: position and velocity in closed form. */
void motion_hermite(struct vec2 from_m, struct vec2 from_mps, struct vec2 to_m, struct vec2 to_mps,
                    double duration_s, double s, struct vec2 *position_m, struct vec2 *velocity_mps,
                    struct vec2 *acceleration_mps2);

#endif
