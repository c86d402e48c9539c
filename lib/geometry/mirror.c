#include "geometry/mirror.h"

#include "base/elementary.h"
#include "geometry/predicates.h"

/* The unit normal towards the outer side; zero for a wall of length zero. */
static struct vec2 normal_of(struct vec2 a, struct vec2 b)
{
    struct vec2 along = vec2_sub(b, a);
    double length_m = vec2_length(along);
    if (length_m == 0)
        return (struct vec2){0, 0};
    return (struct vec2){along.y / length_m, -along.x / length_m};
}

/* Measured from the wall's middle, so that a mirrored wall has the mirrored image to the last bit.
 */
double mirror_height_m(const struct mirror *mirror, struct vec2 point_m)
{
    return vec2_dot_accurate(vec2_sub(point_m, mirror->middle), mirror->normal);
}

static struct vec2 flipped(struct vec2 vector, double height, struct vec2 normal)
{
    return vec2_sub(vector, vec2_scale(2 * height, normal));
}

/* The unit vector to an end of the wall from the sensor's image. It is the mirrored way from the
 * sensor to the end, as the rounding of the image would turn it where the way is short. */
static struct vec2 from_eye(const struct mirror *mirror, struct vec2 end_m)
{
    struct vec2 way = vec2_sub(end_m, mirror->sensor_m);
    way = flipped(way, vec2_dot(way, mirror->normal), mirror->normal);
    return vec2_scale(1 / vec2_length(way), way);
}

struct mirror mirror_of(struct vec2 a, struct vec2 b, struct motion body, struct vec2 sensor_m)
{
    struct mirror mirror = {.a = a,
                            .b = b,
                            .body = body,
                            .sensor_m = sensor_m,
                            .middle = vec2_scale(0.5, vec2_add(a, b)),
                            .normal = normal_of(a, b)};
    double height_m = mirror_height_m(&mirror, sensor_m);
    if (predicates_orientation(a, b, sensor_m) < 0 && height_m > 0) {
        mirror.sensor_height_m = height_m;
        mirror.eye_m = flipped(sensor_m, height_m, mirror.normal);
        mirror.size_m = vec2_length(a) + vec2_length(b) + vec2_length(sensor_m);
        mirror.from_a = vec2_left(from_eye(&mirror, a));
        mirror.from_b = vec2_scale(-1, vec2_left(from_eye(&mirror, b)));
    }
    return mirror;
}

struct vec2 mirror_image_place(const struct mirror *mirror, struct vec2 point_m)
{
    return flipped(point_m, mirror_height_m(mirror, point_m), mirror->normal);
}

struct mirror_image mirror_image(const struct mirror *mirror, struct vec2 point_m,
                                 struct vec2 point_mps)
{
    struct vec2 normal = mirror->normal;
    struct vec2 place_m = mirror_image_place(mirror, point_m);
    struct vec2 seen_mps = vec2_sub(point_mps, motion_velocity_at(&mirror->body, point_m));
    struct vec2 image_mps = flipped(seen_mps, vec2_dot_accurate(seen_mps, normal), normal);
    return (struct mirror_image){
        .place_m = place_m,
        .velocity_mps = vec2_add(motion_velocity_at(&mirror->body, place_m), image_mps),
    };
}

bool mirror_bounce(const struct mirror *mirror, struct vec2 point_m, struct vec2 *bounce_m)
{
    struct vec2 a = mirror->a, b = mirror->b;
    struct vec2 sensor_m = mirror->sensor_m;
    if (mirror->sensor_height_m == 0 || predicates_orientation(a, b, point_m) >= 0)
        return false;
    double height_m = mirror_height_m(mirror, point_m);
    /* A point exactly, but less than a rounding, before an oblique wall has the rounded height
     * 0. */
    if (height_m <= 0)
        return false;
    struct vec2 image_m = flipped(point_m, height_m, mirror->normal);
    if (predicates_orientation(sensor_m, image_m, a) < 0 ||
        predicates_orientation(sensor_m, image_m, b) > 0)
        return false;
    double part = mirror->sensor_height_m / (mirror->sensor_height_m + height_m);
    *bounce_m = vec2_add(sensor_m, vec2_scale(part, vec2_sub(image_m, sensor_m)));
    return true;
}

/* Thousands of times the rounding of what follows: each step costs a few 2^-53 of these lengths. */
static double slack_m(const struct mirror *mirror, struct vec2 centre_m, double radius_m)
{
    return 0x1p-40 * (mirror->size_m + vec2_length(centre_m) + radius_m);
}

bool mirror_may_bounce(const struct mirror *mirror, struct vec2 centre_m, double radius_m)
{
    double reach_m = radius_m + slack_m(mirror, centre_m, radius_m);
    return mirror->sensor_height_m > 0 &&
           !(vec2_dot(vec2_sub(centre_m, mirror->middle), mirror->normal) < -reach_m) &&
           !(vec2_dot(vec2_sub(centre_m, mirror->a), mirror->from_a) < -reach_m) &&
           !(vec2_dot(vec2_sub(centre_m, mirror->b), mirror->from_b) < -reach_m);
}

void mirror_clip(const struct mirror *mirror, struct vec2 from_m, struct vec2 along,
                 double *first_m, double *end_m)
{
    const struct vec2 inward[] = {mirror->normal, mirror->from_a, mirror->from_b};
    const struct vec2 border_m[] = {mirror->middle, mirror->a, mirror->b};
    double slack = slack_m(mirror, from_m, *end_m);
    for (int i = 0; i < 3; i++) {
        double rise = vec2_dot(inward[i], along);
        double least_m = vec2_dot(inward[i], vec2_sub(border_m[i], from_m)) - slack;
        if (rise > 0)
            *first_m = elementary_max(*first_m, least_m / rise);
        else if (rise < 0)
            *end_m = elementary_min(*end_m, least_m / rise);
        else if (least_m > 0)
            *end_m = -(double)INFINITY;
    }
}

struct mirror_ghost mirror_ghost_one_way(double reflection, const struct kinematics *direct,
                                         const struct kinematics *image, double azimuth_rad)
{
    double range_m = (direct->range_m + image->range_m) / 2;
    return (struct mirror_ghost){
        .kinematics = {range_m, azimuth_rad, (direct->range_rate_mps + image->range_rate_mps) / 2},
        .ercs_factor = reflection * (range_m / direct->range_m) * (range_m / image->range_m),
    };
}

struct mirror_ghost mirror_ghost_both_ways(double reflection, const struct kinematics *image)
{
    return (struct mirror_ghost){.kinematics = *image, .ercs_factor = reflection * reflection};
}

bool mirror_specular_point(struct vec2 a, struct vec2 b, struct vec2 along, double margin_m,
                           struct vec2 sensor, struct vec2 *foot)
{
    struct vec2 across = vec2_left(vec2_sub(b, a));
    double square = vec2_dot(across, across);
    if (square == 0 || predicates_orientation(a, b, sensor) >= 0)
        return false;
    struct vec2 margin = vec2_scale(margin_m, along);
    if (predicates_along(vec2_add(a, margin), sensor, along) < 0 ||
        predicates_along(vec2_sub(b, margin), sensor, along) > 0)
        return false;
    /* Measured to the side's middle, so that a mirrored side has the mirrored foot to the last bit,
     * and added to the sensor's place, so that rounding the distance moves the foot along the line
     * of sight, not off it. */
    struct vec2 middle = vec2_scale(0.5, vec2_add(a, b));
    double steps = vec2_dot_accurate(vec2_sub(middle, sensor), across) / square;
    *foot = vec2_add(sensor, vec2_scale(steps, across));
    return true;
}
