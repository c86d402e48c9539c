#include "traffic/road.h"

#include "base/elementary.h"
#include "base/search.h"
#include "base/units.h"
#include "documents/vehicle.h"

#define REAL_OR(owner, member, low, high, missing, help)                                           \
    OPTIONAL_REAL(owner, member, low, high, help), .absent = (missing)

static const struct field point_fields[] = {
    {FIELD_REAL_IN(struct road_point, x_m, -1e9, 1e9, "of the road's line")},
    {FIELD_REAL_IN(struct road_point, y_m, -1e9, 1e9, "of the road's line")},
    {0},
};

static const struct record road_point_record = {
    FIELD_TABLE(struct road_point, point_fields, "point", "A corner of a road's line.")};

static const struct field signal_fields[] = {
    {FIELD_REAL_IN(struct road_signal, at_m, 0, 1e6, "place of the stop line along the lane")},
    {FIELD_REAL_IN(struct road_signal, green_s, 0, 1e6, "how long it is green")},
    {FIELD_REAL_IN(struct road_signal, red_s, 0, 1e6, "how long it is red behind that")},
    {REAL_OR(struct road_signal, offset_s, 0, 1e6, 0, "when warmup_s begins, this long green")},
    {0},
};

static const struct record signal_record = {FIELD_TABLE(
    struct road_signal, signal_fields, "signal", "A light where vehicles stop while it is red.")};

static const struct field arrivals_fields[] = {
    {FIELD_NAME_OF(struct road_arrivals, class, "names the vehicle document")},
    {FIELD_REAL_IN(struct road_arrivals, flow_per_h, 0, 1e4,
                   "how many come in an hour, as a Poisson process")},
    {REAL_OR(struct road_arrivals, length_m, 0, 100, 0, "0: the default of the class")},
    {REAL_OR(struct road_arrivals, width_m, 0, 100, 0, "0: the default of the class")},
    {REAL_OR(struct road_arrivals, height_m, 0, 100, 0, "0: the default of the class")},
    {REAL_OR(struct road_arrivals, speed_mps, 0.1, 100, 100,
             "wanted where the limit is higher; absent: 100 m/s")},
    {REAL_OR(struct road_arrivals, headway_s, 0, 100, 1.6, "IDM's T; absent: 1.6 s")},
    {REAL_OR(struct road_arrivals, gap_m, 0.5, 100, 2, "IDM's s0; absent: 2 m")},
    {REAL_OR(struct road_arrivals, acceleration_mps2, 0.1, 10, 0.73, "IDM's a; absent: 0.73 m/s²")},
    {REAL_OR(struct road_arrivals, deceleration_mps2, 0.1, 10, 1.67, "IDM's b; absent: 1.67 m/s²")},
    {REAL_OR(struct road_arrivals, spread, 0, 0.5, 0.1,
             "size, speed, T, a and b are each within this share of theirs; absent: 0.1")},
    {REAL_OR(struct road_arrivals, ego_m, 0, 1e6, -1,
             "after warmup_s the first to come by here is the ego, at time 0; absent: none")},
    {0},
};

static const struct record arrivals_record = {
    FIELD_TABLE(struct road_arrivals, arrivals_fields, "arrivals",
                "Vehicles of a class, driven by the Intelligent Driver Model (IDM).")};

static const struct field lane_fields[] = {
    {FIELD_REAL_IN(struct road_lane, offset_m, -100, 100,
                   "of its middle from the road's line, left positive")},
    {OPTIONAL_FLAG(struct road_lane, oncoming, "it leads from the last point to the first")},
    {FIELD_REAL_IN(struct road_lane, limit_mps, 0.1, 100, "what drivers want to drive")},
    {FIELD_LIST_OF(struct road_lane, arrivals, &arrivals_record,
                   "who comes; who finds no safe gap waits outside")},
    {OPTIONAL_LIST(struct road_lane, signals, &signal_record, "lights")},
    {0},
};

static const struct record lane_record = {FIELD_TABLE(
    struct road_lane, lane_fields, "lane", "A lane, which nobody leaves but at its end.")};

static const struct field road_fields[] = {
    {FIELD_NAME_OF(struct roadway, id, "its vehicles are ID.LANE.NUMBER, from 0")},
    {REAL_OR(struct roadway, radius_m, 3, 1e6, 1e6,
             "of the arcs at corners, at most; legs leave room for less")},
    {FIELD_LIST_OF(struct roadway, points, &road_point_record, "the line")},
    {FIELD_LIST_OF(struct roadway, lanes, &lane_record, "beside the line")},
    {0},
};

const struct record roadway_record = {FIELD_TABLE(struct roadway, road_fields, "road",
                                                  "Lanes beside a line, and who comes on them.")};

static int check_lane(const struct road_lane *lane, int *egos, struct diag *diag)
{
    for (size_t i = 0; i < lane->arrivals.count; i++) {
        *egos += lane->arrivals.items[i].ego_m >= 0;
        if (vehicle_check_class(lane->arrivals.items[i].class, diag) != 0)
            return diag_prefix(diag, "arrivals[%zu].class: ", i);
    }
    return 0;
}

int road_check(const struct roadway *road, int *egos, struct diag *diag)
{
    const struct road_point *points = road->points.items;
    if (road->points.count < 2)
        return diag_fail(diag, DIAG_CONFIG, "points: %zu; expected two or more",
                         road->points.count);
    for (size_t i = 1; i < road->points.count; i++)
        if (points[i].x_m == points[i - 1].x_m && points[i].y_m == points[i - 1].y_m)
            return diag_fail(diag, DIAG_CONFIG, "points[%zu]: the place of the one before", i);
    for (size_t i = 0; i < road->lanes.count; i++)
        if (check_lane(&road->lanes.items[i], egos, diag) != 0)
            return diag_prefix(diag, "lanes[%zu].", i);
    return road->lanes.count > 0 ? 0 : diag_fail(diag, DIAG_CONFIG, "lanes: none; expected one");
}

void road_scale_flow(struct roadway *road, double factor)
{
    for (size_t i = 0; i < road->lanes.count; i++)
        for (size_t k = 0; k < road->lanes.items[i].arrivals.count; k++)
            road->lanes.items[i].arrivals.items[k].flow_per_h *= factor;
}

void road_shift(struct roadway *road, struct vec2 origin_m)
{
    for (size_t i = 0; i < road->points.count; i++) {
        road->points.items[i].x_m -= origin_m.x;
        road->points.items[i].y_m -= origin_m.y;
    }
}

/* ---- the way of a lane ---- */

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

static void add_piece(struct road_path *path, const struct leg *leg, double along_m,
                      double offset_m, double curvature_radpm, double length_m, struct arena *arena)
{
    struct vec2 aside_m = vec2_scale(offset_m, vec2_left(leg->heading));
    struct vec2 begin_m = vec2_add(leg->begin_m, vec2_scale(along_m, leg->heading));
    *list_add(&path->pieces, arena) = (struct road_piece){
        path->length_m, vec2_add(begin_m, aside_m), leg->yaw_rad, curvature_radpm};
    path->length_m += length_m;
}

int road_path_make(struct road_path *path, const struct roadway *road, const struct road_lane *lane,
                   struct arena *arena, struct diag *diag)
{
    size_t legs = road->points.count - 1;
    double offset_m = lane->oncoming ? -lane->offset_m : lane->offset_m;
    struct leg leg = leg_of(road, lane->oncoming, 0);
    struct corner before = {0}, after;
    *path = (struct road_path){.radius_m = (double)INFINITY};
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

struct motion road_path_motion(const struct road_path *path, double place_m, double speed_mps)
{
    const struct road_piece *pieces = path->pieces.items;
    const struct road_piece *piece =
        pieces + search_row(&pieces[0].from_m, sizeof *pieces, path->pieces.count, place_m);
    struct motion body = motion_drive(piece->begin_m, piece->yaw_rad, 1, 0, piece->curvature_radpm,
                                      place_m - piece->from_m);
    body.yaw_rad = units_wrap_rad(body.yaw_rad);
    body.velocity_mps = vec2_scale(speed_mps, vec2_heading(body.yaw_rad));
    body.yaw_rate_radps = speed_mps * piece->curvature_radpm;
    return body;
}
