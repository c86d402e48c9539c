/* Flat sides that mirror: specular points, images and ghosts (MODEL 2.3, 14.1).
 *
 * A flat side, or wall, is the segment a to b with its outer face to the right of a -> b. Only that
 * face mirrors: a guardrail has two. The wall may move and turn with its body. With the unit normal
 * n and the height h = n · (o - a) of a point o over the wall, the image is
 *
 *     o' = o - 2 h n,   v' = V(o') + w - 2 (n · w) n,   w = v - V(o),
 *
 * where V is the velocity of the body's material at a place. Metres and metres per second, in one
 * plane. */
#pragma once

#include "geometry/kinematics.h"

/* True if a side has a specular point for the sensor, the place that mirrors the radar's wave back;
 * sets foot: the foot of the perpendicular from the sensor, after the segment is shortened by
 * margin_m at both ends. along is the unit vector from a to b. A segment of length zero (below
 * 1e-160 m) has no specular point.
 *
 * The ends are decided exactly, by the projection onto along, not onto b - a, whose rounding bends
 * joints. If two sides in line share a vertex and the doubles of along, one of them has the foot
 * near the joint; both have it only if it is the vertex itself, and line_of_sight.h then chooses
 * one.
 *
 * The foot is rounded. For a side parallel to an axis the line of sight is exactly perpendicular,
 * so an outline that it touches blocks it. For other sides the line is off by up to 2 ulp of the
 * largest coordinate or distance, so it may miss an outline that it only touches. */
bool mirror_specular_point(struct vec2 a, struct vec2 b, struct vec2 along, double margin_m,
                           struct vec2 sensor, struct vec2 *foot);

/* A wall and one sensor, and the members that mirror_of computes from both. */
struct mirror {
    struct vec2 a, b;
    struct motion body; /* {0} for a wall that stands */
    struct vec2 sensor_m;
    double size_m;              /* a bound of the coordinates, for the rounding of what follows */
    struct vec2 middle, normal; /* the unit normal towards the outer side; zero if a == b */
    double sensor_height_m;     /* over the wall's line; 0 if it is not before the outer face */
    struct vec2 eye_m;          /* the sensor's image in the wall, if sensor_height_m > 0 */
    struct vec2 from_a, from_b; /* unit vectors that point into the sector, away from its borders */
};

struct mirror_image {
    struct vec2 place_m, velocity_mps;
};

struct mirror mirror_of(struct vec2 a, struct vec2 b, struct motion body, struct vec2 sensor_m);

/* Height of a point over the wall's line, positive on the outer side; 0 for a wall of length zero.
 */
double mirror_height_m(const struct mirror *mirror, struct vec2 point_m);

/* The image of any point, on either side; a point on the wall is its own image. */
struct vec2 mirror_image_place(const struct mirror *mirror, struct vec2 point_m);
struct mirror_image mirror_image(const struct mirror *mirror, struct vec2 point_m,
                                 struct vec2 point_mps);

/* True if the wall mirrors the point towards the sensor; sets bounce_m, the place on the wall. Both
 * must be strictly on the wall's outer side, and the line from the sensor to the image must cross
 * the segment, ends included. Exact signs (predicates.h) of the rounded image decide. There is no
 * bounce for a wall of length zero, or if sensor or point lies behind the wall or on its line,
 * exactly or after rounding. A mirrored scene has exactly the mirrored answer. */
bool mirror_bounce(const struct mirror *mirror, struct vec2 point_m, struct vec2 *bounce_m);

/* False only if mirror_bounce is false for every point within radius_m of the centre, for
 * coordinates up to 1e7 m. May be true without need where the disc passes close by an end of the
 * wall. */
bool mirror_may_bounce(const struct mirror *mirror, struct vec2 centre_m, double radius_m);

/* Cuts a stretch of the line that runs from from_m along a unit vector, from *first_m >= 0 to
 * *end_m, to a part with all its places for which mirror_bounce is true; ends are swapped if there
 * is none. */
void mirror_clip(const struct mirror *mirror, struct vec2 from_m, struct vec2 along,
                 double *first_m, double *end_m);

/* A ghost: the echo of an object O along a path from the sensor S by way of a wall W. */
struct mirror_ghost {
    struct kinematics kinematics; /* as the radar measures them */
    /* Factor on the ERCS of O, >= 0: the reflection of the bounces, times the ratio of the
     * spreading along the path to that of an echo at the ghost's range. */
    double ercs_factor;
};

/* The ghosts with one bounce, S-W-O-S and S-O-W-S, and with two, S-W-O-W-S. direct and image are
 * the kinematics of O and of its image O' (mirror_image), at ranges > 0. azimuth_rad is that of the
 * wave that comes back: of O on S-W-O-S, of O' on S-O-W-S. These paths exist where mirror_bounce is
 * true. The loss at a bistatic angle is not included. */
struct mirror_ghost mirror_ghost_one_way(double reflection, const struct kinematics *direct,
                                         const struct kinematics *image, double azimuth_rad);
struct mirror_ghost mirror_ghost_both_ways(double reflection, const struct kinematics *image);
