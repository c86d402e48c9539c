#include "traffic/road.h"

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
