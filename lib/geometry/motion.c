#include "geometry/motion.h"

#include "base/elementary.h"
#include "base/units.h"

/* j1(h) = (si h - cos h) / h. Below 1.5 the difference cancels and the power series
 * h/3 (1 - h^2/(2 5) (1 - h^2/(4 7) (1 - h^2/(6 9) ...))) takes its place; the first term left out
 * is less than 2e-17 of the sum. */
static double j1_of(double h)
{
    if (fabs(h) > 1.5)
        return (units_si(h) - elementary_cos(h)) / h;
    if (h == 0)
        return h;
    double sum = 1;
    for (int k = 9; k >= 1; k--)
        sum = 1 - h * h / (2 * k * (2 * k + 3)) * sum;
    return h / 3 * sum;
}

struct motion motion_drive(struct vec2 position_m, double yaw_rad, double speed_mps,
                           double acceleration_mps2, double yaw_rate_radps, double duration_s)
{
    double half_turn_rad = yaw_rate_radps * duration_s / 2;
    double half_gain_mps = acceleration_mps2 * duration_s / 2;
    struct vec2 mean_mps = {(speed_mps + half_gain_mps) * units_si(half_turn_rad),
                            half_gain_mps * j1_of(half_turn_rad)};
    struct vec2 moved_m =
        vec2_scale(duration_s, vec2_turn(mean_mps, vec2_heading(yaw_rad + half_turn_rad)));
    double end_yaw_rad = yaw_rad + yaw_rate_radps * duration_s;
    double end_speed_mps = speed_mps + acceleration_mps2 * duration_s;
    return (struct motion){
        .position_m = vec2_add(position_m, moved_m),
        .velocity_mps = vec2_scale(end_speed_mps, vec2_heading(end_yaw_rad)),
        .yaw_rad = end_yaw_rad,
        .yaw_rate_radps = yaw_rate_radps,
    };
}

double motion_drive_length_m(double speed_mps, double acceleration_mps2, double duration_s)
{
    double end_mps = speed_mps + acceleration_mps2 * duration_s;
    if (speed_mps * end_mps >= 0)
        return fabs((speed_mps + end_mps) / 2 * duration_s);
    return (speed_mps * speed_mps + end_mps * end_mps) / (2 * fabs(acceleration_mps2));
}

struct motion motion_after(struct motion body, double duration_s)
{
    double turn_rad = body.yaw_rate_radps * duration_s;
    struct vec2 half_turned_mps = vec2_turn(body.velocity_mps, vec2_heading(turn_rad / 2));
    struct vec2 moved_m = vec2_scale(duration_s * units_si(turn_rad / 2), half_turned_mps);
    return (struct motion){
        .position_m = vec2_add(body.position_m, moved_m),
        .velocity_mps = vec2_turn(body.velocity_mps, vec2_heading(turn_rad)),
        .yaw_rad = body.yaw_rad + turn_rad,
        .yaw_rate_radps = body.yaw_rate_radps,
    };
}

struct vec2 motion_velocity_at(const struct motion *body, struct vec2 place)
{
    struct vec2 arm_m = vec2_sub(place, body->position_m);
    return vec2_add(body->velocity_mps, vec2_scale(body->yaw_rate_radps, vec2_left(arm_m)));
}

static struct vec2 weighted(double i, struct vec2 a, double j, struct vec2 b, double k,
                            struct vec2 c)
{
    return vec2_add(vec2_scale(i, a), vec2_add(vec2_scale(j, b), vec2_scale(k, c)));
}

void motion_hermite(struct vec2 from_m, struct vec2 from_mps, struct vec2 to_m, struct vec2 to_mps,
                    double duration_s, double s, struct vec2 *position_m, struct vec2 *velocity_mps,
                    struct vec2 *acceleration_mps2)
{
    double rest = 1 - s;
    struct vec2 mean_mps = vec2_scale(1 / duration_s, vec2_sub(to_m, from_m));
    struct vec2 moved_m =
        vec2_scale(duration_s, weighted(s * s * (3 - 2 * s), mean_mps, s * rest * rest, from_mps,
                                        -s * s * rest, to_mps));
    *position_m = vec2_add(from_m, moved_m);
    *velocity_mps =
        weighted(6 * s * rest, mean_mps, rest * (1 - 3 * s), from_mps, s * (3 * s - 2), to_mps);
    struct vec2 gained_mps = weighted(6 - 12 * s, mean_mps, 6 * s - 4, from_mps, 6 * s - 2, to_mps);
    *acceleration_mps2 = vec2_scale(1 / duration_s, gained_mps);
}

double motion_monotone_share(double from_mps, double to_mps, double mean_mps)
{
    if (!(mean_mps > 0))
        return from_mps == 0 && to_mps == 0 ? 1 : 0;
    double from = from_mps / mean_mps, to = to_mps / mean_mps;
    /* The speed along the curve is a parabola. If its least value lies between the ends, it is the
     * last of these terms. */
    bool dips = from + to > 2 && 2 * from + to > 3 && from + 2 * to > 3;
    double turn = 2 * from + to - 3;
    if (!dips || from - turn * turn / (3 * (from + to - 2)) >= 0)
        return 1;
    return 3 / elementary_hypot(from, to);
}

void motion_box_outline(const struct box *box, struct vec2 corner[4])
{
    /* The places that motion_box_place gives, from the same four products. */
    struct vec2 centre = box->motion.position_m;
    struct vec2 ahead = vec2_scale(0.5 * box->length_m, box->heading);
    struct vec2 left = vec2_left(vec2_scale(0.5 * box->width_m, box->heading));
    struct vec2 front_left = vec2_add(ahead, left), front_right = vec2_sub(ahead, left);
    corner[0] = vec2_add(centre, front_left);
    corner[1] = vec2_sub(centre, front_right);
    corner[2] = vec2_sub(centre, front_left);
    corner[3] = vec2_add(centre, front_right);
}

struct vec2 motion_box_along(const struct box *box, double from_x, double from_y, double to_x,
                             double to_y)
{
    struct vec2 own = {(to_x - from_x) * box->length_m, (to_y - from_y) * box->width_m};
    double length = vec2_length(own);
    return vec2_turn((struct vec2){own.x / length, own.y / length}, box->heading);
}
