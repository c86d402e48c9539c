#include "traffic/lane_path.h"

#include "base/elementary.h"
#include "base/units.h"

enum { NARROWEST_M = 3 };

struct leg {
    struct vec2 begin_m, heading;
    double yaw_rad, length_m;
};

/* A leg of the road's line, as an oncoming lane sees it from the other end. */
static struct leg leg_of(const struct roadway *road, bool oncoming, size_t number)
{
    const struct road_point *points = road->points.items;
    size_t last = road->points.count - 1;
    const struct road_point *from = &points[oncoming ? last - number : number];
    const struct road_point *to = oncoming ? from - 1 : from + 1;
    struct vec2 begin_m = {from->x_m, from->y_m}, end_m = {to->x_m, to->y_m};
    struct vec2 way_m = vec2_sub(end_m, begin_m);
    double yaw_rad = elementary_atan2(way_m.y, way_m.x);
    return (struct leg){begin_m, vec2_heading(yaw_rad), yaw_rad,
                        elementary_hypot(way_m.x, way_m.y)};
}

/* A corner of the line; its angle is 0 where there is none. */
struct corner {
    double turn_rad, radius_m; /* of the lane's arc, both positive to the left */
    double cut_m;              /* what the arc takes of each leg */
};

static int round_corner(const struct leg *leg, const struct leg *next, double most_m,
                        double offset_m, struct corner *corner, struct diag *diag)
{
    *corner = (struct corner){.turn_rad = elementary_wrap(next->yaw_rad - leg->yaw_rad)};
    if (corner->turn_rad == 0)
        return 0;
    struct elementary_sincos half = elementary_sincos(corner->turn_rad / 2);
    double sign = corner->turn_rad < 0 ? -1 : 1, slope = fabs(half.sin) / half.cos;
    double radius_m =
        elementary_min(most_m, elementary_min(leg->length_m, next->length_m) / 2 / slope);
    corner->radius_m = sign * radius_m - offset_m;
    corner->cut_m = radius_m * slope;
    if (sign * corner->radius_m >= NARROWEST_M)
        return 0;
    return diag_fail(diag, DIAG_CONFIG,
                     "corner at (%g, %g): the lane turns there with a radius of %.3g m; expected "
                     "%d m or more",
                     next->begin_m.x, next->begin_m.y, sign * corner->radius_m, NARROWEST_M);
}

static void add_piece(struct lane_path *path, const struct leg *leg, double along_m,
                      double offset_m, double curvature_radpm, double length_m, struct arena *arena)
{
    struct vec2 aside_m = vec2_scale(offset_m, vec2_left(leg->heading));
    struct vec2 begin_m = vec2_add(leg->begin_m, vec2_scale(along_m, leg->heading));
    *list_add(&path->pieces, arena) = (struct lane_piece){
        path->length_m, vec2_add(begin_m, aside_m), leg->yaw_rad, curvature_radpm};
    path->length_m += length_m;
}

int lane_path_make(struct lane_path *path, const struct roadway *road, const struct road_lane *lane,
                   struct arena *arena, struct diag *diag)
{
    size_t legs = road->points.count - 1;
    double offset_m = lane->oncoming ? -lane->offset_m : lane->offset_m;
    struct leg leg = leg_of(road, lane->oncoming, 0);
    struct corner before = {0}, after;
    *path = (struct lane_path){.radius_m = (double)INFINITY};
    for (size_t i = 0; i < legs; i++) {
        struct leg next = i + 1 < legs ? leg_of(road, lane->oncoming, i + 1) : leg;
        if (round_corner(&leg, &next, road->radius_m, offset_m, &after, diag) != 0)
            return -1;
        double straight_m = leg.length_m - before.cut_m - after.cut_m;
        add_piece(path, &leg, before.cut_m, offset_m, 0, straight_m, arena);
        if (after.turn_rad != 0) {
            add_piece(path, &leg, leg.length_m - after.cut_m, offset_m, 1 / after.radius_m,
                      after.radius_m * after.turn_rad, arena);
            path->radius_m = elementary_min(path->radius_m, fabs(after.radius_m));
        }
        before = after;
        leg = next;
    }
    return 0;
}

struct motion lane_path_motion(const struct lane_path *path, double place_m, double speed_mps)
{
    const struct lane_piece *piece = path->pieces.items;
    const struct lane_piece *last = piece + path->pieces.count - 1;
    while (piece < last && piece[1].from_m <= place_m)
        piece++;
    struct motion body = motion_drive(piece->begin_m, piece->yaw_rad, 1, 0, piece->curvature_radpm,
                                      place_m - piece->from_m);
    body.yaw_rad = units_wrap_rad(body.yaw_rad);
    body.velocity_mps = vec2_scale(speed_mps, vec2_heading(body.yaw_rad));
    body.yaw_rate_radps = speed_mps * piece->curvature_radpm;
    return body;
}
