#include "traffic/adversarial_traffic.h"

#include <inttypes.h>
#include <stdio.h>

#include "base/elementary.h"
#include "base/units.h"
#include "geometry/sensor_pose.h"

#define AMPLITUDE_MARGIN 1e-3
#define SPACING_MARGIN 1e-6

/* One case in the making: the sensor it is for and how that stands in the world. */
struct site {
    struct frame *frame;
    const struct random_model *models;
    const struct sensor *sensor;
    struct sensor_pose pose;
    struct random_sequence draws;
    const char *name;
    int64_t number;
    int objects;
};

/* What the sensor shall see of a point. */
struct spot {
    enum random_class class;
    double range_m, azimuth_rad, range_rate_mps;
};

static struct vec2 direction_to(const struct site *site, double azimuth_rad)
{
    return vec2_turn(vec2_heading(azimuth_rad), site->pose.boresight);
}

static struct vec2 place_at(const struct site *site, double range_m, double azimuth_rad)
{
    struct vec2 line = direction_to(site, azimuth_rad);
    return vec2_add(site->pose.position_m, vec2_scale(range_m, line));
}

static struct object *add_object(struct site *site, enum random_class class, struct vec2 place)
{
    char *id = arena_get(site->frame->arena, 40);
    snprintf(id, 40, "%s-%" PRId64 "-%d", site->name, site->number, ++site->objects);
    struct object *object = list_add(&site->frame->objects, site->frame->arena);
    *object = (struct object){
        .id = id, .class = random_traffic_class_name(class), .x_m = place.x, .y_m = place.y};
    return object;
}

static void add_spot(struct site *site, const struct spot *spot)
{
    struct vec2 line = direction_to(site, spot->azimuth_rad);
    struct vec2 place = vec2_add(site->pose.position_m, vec2_scale(spot->range_m, line));
    struct object *object = add_object(site, spot->class, place);
    object->vx_mps = site->pose.velocity_mps.x + spot->range_rate_mps * line.x;
    object->vy_mps = site->pose.velocity_mps.y + spot->range_rate_mps * line.y;
}

/* A box of which the place at fractions (x, y) is at place. */
static struct object *add_box(struct site *site, enum random_class class, double yaw_rad, double x,
                              double y, struct vec2 place)
{
    const struct random_model *model = &site->models[class];
    struct vec2 own = {x * model->length_m, y * model->width_m};
    struct vec2 centre = vec2_sub(place, vec2_turn(own, vec2_heading(yaw_rad)));
    struct object *object = add_object(site, class, centre);
    object->yaw_rad = units_wrap_rad(yaw_rad);
    object->length_m = model->length_m;
    object->width_m = model->width_m;
    return object;
}

static double amplitude(const struct site *site, const struct spot *spot)
{
    double ercs = site->models[spot->class].reflectors->points.items[0].ercs;
    return suite_amplitude(site->sensor, spot->range_m, spot->azimuth_rad, ercs);
}

static enum random_class draw_point_class(struct random_sequence *draws)
{
    return random_sequence_chance(draws, 0.5) ? RANDOM_POST : RANDOM_PEDESTRIAN;
}

/* Most spots are near enough to be detected: decisions about the others change no target. */
static struct spot draw_spot(struct site *site)
{
    double nearest_m = site->sensor->range_min_m + 3;
    double farthest_m = elementary_min(0.8 * site->sensor->range_max_m, 30);
    double border = 0.8 * suite_border_rad(site->sensor);
    struct spot spot = {
        .class = draw_point_class(&site->draws),
        .range_m = random_sequence_between(&site->draws, elementary_min(nearest_m, farthest_m),
                                           farthest_m),
        .azimuth_rad = random_sequence_between(&site->draws, -border, border),
        .range_rate_mps = random_sequence_between(&site->draws, -20, 20),
    };
    double wanted = random_sequence_chance(&site->draws, 0.8) ? 1.5 * site->sensor->threshold : 0;
    while (spot.range_m > site->sensor->range_min_m + 1.5 && amplitude(site, &spot) < wanted)
        spot.range_m *= 0.9;
    return spot;
}

static double sum_from(const struct site *site, const struct spot *spots, int count, double range_m)
{
    double sum = 0;
    for (int i = 0; i < count; i++) {
        struct spot moved = spots[i];
        moved.range_m += range_m - spots[0].range_m;
        sum += amplitude(site, &moved);
    }
    return sum;
}

/* Moves all spots by one distance in range so that their amplitudes sum to wanted; false if that
 * is out of reach. Bisection ends on neighbouring doubles. */
static bool move_to_sum(const struct site *site, struct spot *spots, int count, double wanted)
{
    double near_m = elementary_max(site->sensor->range_min_m, site->sensor->range_floor_m) +
                    2 * site->sensor->half_range_m;
    double far_m = site->sensor->range_max_m - 2 * site->sensor->half_range_m;
    if (sum_from(site, spots, count, near_m) < wanted ||
        sum_from(site, spots, count, far_m) > wanted)
        return false;
    double middle_m = near_m + (far_m - near_m) / 2;
    while (middle_m > near_m && middle_m < far_m) {
        bool strong = sum_from(site, spots, count, middle_m) >= wanted;
        near_m = strong ? middle_m : near_m;
        far_m = strong ? far_m : middle_m;
        middle_m = near_m + (far_m - near_m) / 2;
    }
    double shift_m = near_m - spots[0].range_m;
    for (int i = 0; i < count; i++)
        spots[i].range_m += shift_m;
    return true;
}

static void build_threshold(struct site *site)
{
    struct spot spots[3] = {draw_spot(site)};
    int count = (int)random_sequence_whole(&site->draws, 1, 3);
    for (int i = 1; i < count; i++) {
        spots[i] = draw_spot(site);
        spots[i].range_m = spots[0].range_m + site->sensor->half_range_m *
                                                  random_sequence_between(&site->draws, -0.4, 0.4);
        spots[i].range_rate_mps = spots[0].range_rate_mps;
    }
    double wanted =
        site->sensor->threshold * (1 + random_sequence_margin(&site->draws, AMPLITUDE_MARGIN));
    for (int i = 0; i < 8 && !move_to_sum(site, spots, count, wanted); i++)
        for (int k = 0; k < count; k++)
            spots[k].azimuth_rad /= 2;
    for (int i = 0; i < count; i++)
        add_spot(site, &spots[i]);
}

/* Turns spot on its side of boresight until its amplitude is wanted; false if that is outside the
 * view. */
static bool turn_to_amplitude(const struct site *site, struct spot *spot, double wanted)
{
    struct spot turned = *spot;
    double side = copysign(1, spot->azimuth_rad), strong_rad = 0,
           weak_rad = suite_border_rad(site->sensor);
    double middle_rad = weak_rad / 2;
    while (middle_rad > strong_rad && middle_rad < weak_rad) {
        turned.azimuth_rad = side * middle_rad;
        bool strong = amplitude(site, &turned) >= wanted;
        strong_rad = strong ? middle_rad : strong_rad;
        weak_rad = strong ? weak_rad : middle_rad;
        middle_rad = strong_rad + (weak_rad - strong_rad) / 2;
    }
    if (strong_rad < 1e-3 || strong_rad > 0.99 * suite_border_rad(site->sensor))
        return false;
    spot->azimuth_rad = side * strong_rad;
    return true;
}

static void build_tie(struct site *site)
{
    struct spot first = draw_spot(site), second = draw_spot(site);
    double wanted =
        amplitude(site, &first) * (1 + random_sequence_margin(&site->draws, AMPLITUDE_MARGIN));
    if (random_sequence_chance(&site->draws, 0.5)) {
        second.class = first.class;
        second.range_rate_mps = first.range_rate_mps;
        second.range_m = first.range_m +
                         site->sensor->half_range_m * random_sequence_between(&site->draws, -3, 3);
        if (!turn_to_amplitude(site, &second, wanted))
            second.azimuth_rad = -first.azimuth_rad;
    }
    move_to_sum(site, &second, 1, wanted);
    add_spot(site, &first);
    add_spot(site, &second);
}

/* A chain of points, each a step from the one before it. */
static void add_chain(struct site *site, double half_cell, bool in_rate)
{
    struct spot spot = draw_spot(site);
    double beside = 1.9 * random_sequence_next(&site->draws) - 0.95;
    int count = (int)random_sequence_whole(&site->draws, 2, 3);
    add_spot(site, &spot);
    for (int i = 1; i < count; i++) {
        double step = half_cell * (1 + random_sequence_margin(&site->draws, SPACING_MARGIN));
        if (in_rate) {
            spot.range_rate_mps += step;
            spot.range_m += beside * site->sensor->half_range_m;
        } else {
            spot.range_m += step;
            spot.range_rate_mps += beside * site->sensor->half_range_rate_mps;
        }
        spot.azimuth_rad = draw_spot(site).azimuth_rad;
        add_spot(site, &spot);
    }
}

static void build_range(struct site *site)
{
    add_chain(site, site->sensor->half_range_m, false);
}

static void build_rate(struct site *site)
{
    add_chain(site, site->sensor->half_range_rate_mps, true);
}

static void build_symmetry(struct site *site)
{
    struct spot spot = draw_spot(site);
    add_spot(site, &spot);
    spot.azimuth_rad = -spot.azimuth_rad + random_sequence_margin(&site->draws, 1e-9);
    add_spot(site, &spot);
}

static void build_view(struct site *site)
{
    struct spot spot = draw_spot(site);
    double margin_rad = random_sequence_margin(&site->draws, 1e-7);
    bool border = random_sequence_chance(&site->draws, 0.6);
    spot.azimuth_rad = border ? copysign(suite_border_rad(site->sensor), spot.azimuth_rad) : 0;
    spot.azimuth_rad += margin_rad;
    add_spot(site, &spot);
}

static void build_reach(struct site *site)
{
    struct spot spot = draw_spot(site);
    bool largest = random_sequence_chance(&site->draws, 0.5);
    spot.range_m = largest ? site->sensor->range_max_m : site->sensor->range_min_m;
    spot.range_m *= 1 + random_sequence_margin(&site->draws, 1e-9);
    add_spot(site, &spot);
}

/* A box whose front corner on that side (1 left) touches the sight line to spot: its sides all
 * lie beyond. */
static void add_grazing_box(struct site *site, const struct spot *spot, double side)
{
    static const enum random_class classes[] = {RANDOM_CAR, RANDOM_VAN, RANDOM_BUS, RANDOM_WALL};
    struct vec2 line = direction_to(site, spot->azimuth_rad);
    double turned_rad = side * -PI / 2 * (1 + random_sequence_next(&site->draws));
    struct vec2 corner = place_at(site, spot->range_m, spot->azimuth_rad);
    add_box(site, classes[random_sequence_whole(&site->draws, 0, 3)],
            elementary_atan2(line.y, line.x) + turned_rad, 0.5, side * 0.5, corner);
}

static void build_grazing(struct site *site)
{
    struct spot spot = draw_spot(site);
    double side = random_sequence_sign(&site->draws);
    add_grazing_box(site, &spot, side);
    if (random_sequence_chance(&site->draws, 0.5)) {
        spot.range_m *= random_sequence_between(&site->draws, 1.05, 1.4);
        add_grazing_box(site, &spot, -side);
    }
    spot.range_m *= random_sequence_between(&site->draws, 1.05, 1.5);
    spot.azimuth_rad += random_sequence_margin(&site->draws, 1e-9);
    add_spot(site, &spot);
}

/* A sight line along x and a side of a car on it exactly: all places keep the mount's y. */
static void build_along_side(struct site *site)
{
    struct vec2 mount = site->pose.position_m;
    double side = mount.y > 0 ? 1 : -1;
    double ahead_m = random_sequence_between(&site->draws, 3, 20);
    struct vec2 centre = {mount.x + ahead_m, mount.y - side};
    struct object *car = add_object(site, RANDOM_CAR, centre);
    car->length_m = 4;
    car->width_m = 2;
    struct vec2 behind = {centre.x + random_sequence_between(&site->draws, 2, 8), mount.y};
    int64_t step = random_sequence_whole(&site->draws, -1, 1);
    if (step != 0)
        behind.y = nextafter(behind.y, behind.y + (double)step);
    add_object(site, draw_point_class(&site->draws), behind);
}

static void build_touch(struct site *site)
{
    const struct object *ego = &site->frame->objects.items[0];
    bool exact = ego->x_m == 0 && ego->y_m == 0 && ego->yaw_rad == 0;
    if (exact && fabs(site->sensor->mount_yaw_rad) < suite_border_rad(site->sensor) &&
        random_sequence_chance(&site->draws, 0.5))
        build_along_side(site);
    else
        build_grazing(site);
}

static void build_facing(struct site *site)
{
    const struct reflector_set *car = site->models[RANDOM_CAR].reflectors;
    size_t which = (size_t)random_sequence_whole(&site->draws, 0, (int64_t)car->points.count - 1);
    const struct point_reflector *point = &car->points.items[which];
    struct spot spot = draw_spot(site);
    struct vec2 line = direction_to(site, spot.azimuth_rad);
    double edge_rad = random_sequence_chance(&site->draws, 0.5) ? point->full_rad : point->zero_rad;
    double off_rad = random_sequence_sign(&site->draws) *
                     (edge_rad + random_sequence_margin(&site->draws, 1e-6));
    add_box(site, RANDOM_CAR, elementary_atan2(-line.y, -line.x) - point->facing_rad - off_rad,
            point->x, point->y, place_at(site, spot.range_m, spot.azimuth_rad));
}

static void build_foot(struct site *site)
{
    struct spot spot = draw_spot(site);
    struct vec2 line = direction_to(site, spot.azimuth_rad);
    struct vec2 aside = vec2_scale(random_sequence_margin(&site->draws, 1e-9), vec2_left(line));
    struct vec2 end = vec2_add(place_at(site, spot.range_m, spot.azimuth_rad), aside);
    add_box(site, RANDOM_CAR, elementary_atan2(line.y, line.x), -0.5,
            random_sequence_sign(&site->draws) * 0.5, end);
}

static void build_against(struct site *site)
{
    struct spot spot = draw_spot(site);
    struct vec2 line = direction_to(site, spot.azimuth_rad);
    add_box(site, RANDOM_CAR, elementary_atan2(line.y, line.x), -0.5,
            random_sequence_between(&site->draws, -0.4, 0.4),
            place_at(site, spot.range_m, spot.azimuth_rad));
    spot.range_m += random_sequence_margin(&site->draws, 1e-8);
    add_spot(site, &spot);
}

static const struct {
    const char *name;
    void (*build)(struct site *site);
} cases[] = {
    {"threshold", build_threshold}, {"tie", build_tie},           {"range", build_range},
    {"rate", build_rate},           {"symmetry", build_symmetry}, {"view", build_view},
    {"reach", build_reach},         {"touch", build_touch},       {"facing", build_facing},
    {"foot", build_foot},           {"against", build_against},
};

static void build(struct site *site, const struct suite *suite)
{
    enum { LAST_SORT = sizeof cases / sizeof *cases - 1 };
    struct motion ego = frame_motion(&site->frame->objects.items[0], 0);
    int64_t which = random_sequence_whole(&site->draws, 0, (int64_t)suite->sensors.count - 1);
    site->sensor = &suite->sensors.items[which];
    site->pose = sensor_pose_on(&ego, site->sensor->mount_x_m, site->sensor->mount_y_m,
                                site->sensor->mount_yaw_rad);
    int64_t sort = random_sequence_whole(&site->draws, 0, LAST_SORT);
    site->name = cases[sort].name;
    cases[sort].build(site);
}

void adversarial_traffic_add(const struct random_traffic *scene, const struct suite *suite,
                             int64_t number, struct frame *frame)
{
    struct random_address address = random_traffic_address(scene, frame->seed, number);
    struct random_sequence draws = random_sequence_at(address, RANDOM_HARD_CASE);
    int64_t count = random_sequence_whole(&draws, 1, 3);
    for (int64_t i = 1; i <= count; i++) {
        address.item = (uint64_t)i;
        struct site site = {.frame = frame,
                            .models = scene->models,
                            .draws = random_sequence_at(address, RANDOM_HARD_CASE),
                            .number = i};
        build(&site, suite);
    }
}
