#include "adversarial_traffic.h"

#include <inttypes.h>
#include <stdio.h>

#include "base/elementary.h"
#include "base/units.h"
#include "geometry/kinematics.h"

#define AMPLITUDE_MARGIN 1e-3
#define SPACING_MARGIN 1e-6

const struct random_traffic_density adversarial_traffic_density = {"adversarial", 0, 3, 60, 20,
                                                                   true};

/* A case that is being built, and the sensor for which it is built. */
struct builder {
    struct frame *frame;
    const struct random_traffic_model *models;
    const struct sensor *sensor;
    struct sensor_pose pose;
    struct random_sequence sequence;
    const char *name;
    int64_t number;
    int objects;
};

/* A point as the sensor shall see it. */
struct spot {
    enum random_traffic_class class;
    double range_m, azimuth_rad, range_rate_mps;
};

double adversarial_traffic_margin(struct random_sequence *sequence, double largest)
{
    if (random_sequence_chance(sequence, 0.125))
        return 0;
    double sign = random_sequence_sign(sequence);
    return sign * largest * elementary_pow(10, -6 * random_sequence_next(sequence));
}

static struct vec2 direction_to(const struct builder *builder, double azimuth_rad)
{
    return vec2_turn(vec2_heading(azimuth_rad), builder->pose.boresight);
}

static struct vec2 place_at(const struct builder *builder, double range_m, double azimuth_rad)
{
    struct vec2 line = direction_to(builder, azimuth_rad);
    return vec2_add(builder->pose.position_m, vec2_scale(range_m, line));
}

static struct object *add_object(struct builder *builder, enum random_traffic_class class,
                                 struct vec2 place)
{
    char *id = arena_get(builder->frame->arena, 40);
    snprintf(id, 40, "%s-%" PRId64 "-%d", builder->name, builder->number, ++builder->objects);
    struct object *object = list_add(&builder->frame->objects, builder->frame->arena);
    *object = (struct object){
        .id = id, .class = random_traffic_class_name(class), .x_m = place.x, .y_m = place.y};
    return object;
}

static void add_spot(struct builder *builder, const struct spot *spot)
{
    struct vec2 line = direction_to(builder, spot->azimuth_rad);
    struct vec2 place = vec2_add(builder->pose.position_m, vec2_scale(spot->range_m, line));
    struct object *object = add_object(builder, spot->class, place);
    object->vx_mps = builder->pose.velocity_mps.x + spot->range_rate_mps * line.x;
    object->vy_mps = builder->pose.velocity_mps.y + spot->range_rate_mps * line.y;
}

/* A box whose place at the fractions (x, y) of its sides lies at place. */
static struct object *add_box(struct builder *builder, enum random_traffic_class class,
                              double yaw_rad, double x, double y, struct vec2 place)
{
    const struct random_traffic_model *model = &builder->models[class];
    struct vec2 own = {x * model->length_m, y * model->width_m};
    struct vec2 centre = vec2_sub(place, vec2_turn(own, vec2_heading(yaw_rad)));
    struct object *object = add_object(builder, class, centre);
    object->yaw_rad = units_wrap_rad(yaw_rad);
    object->length_m = model->length_m;
    object->width_m = model->width_m;
    return object;
}

static double amplitude(const struct builder *builder, const struct spot *spot)
{
    double ercs = builder->models[spot->class].reflectors->points.items[0].ercs;
    return radar_amplitude(&builder->sensor->amplitude_law, &builder->sensor->antenna,
                           spot->range_m, spot->azimuth_rad, ercs);
}

static enum random_traffic_class draw_point_class(struct random_sequence *sequence)
{
    return random_sequence_chance(sequence, 0.5) ? TRAFFIC_POST : TRAFFIC_PEDESTRIAN;
}

/* A point in the field of view, in most cases near enough to be detected: decisions about
 * undetected points change no target. */
static struct spot draw_spot(struct builder *builder)
{
    double nearest_m = builder->sensor->range_min_m + 3;
    double farthest_m = elementary_min(0.8 * builder->sensor->range_max_m, 30);
    double border = 0.8 * antenna_border_rad(builder->sensor->field_of_view_rad);
    struct spot spot = {
        .class = draw_point_class(&builder->sequence),
        .range_m = random_sequence_between(&builder->sequence,
                                           elementary_min(nearest_m, farthest_m), farthest_m),
        .azimuth_rad = random_sequence_between(&builder->sequence, -border, border),
        .range_rate_mps = random_sequence_between(&builder->sequence, -20, 20),
    };
    double wanted =
        random_sequence_chance(&builder->sequence, 0.8) ? 1.5 * builder->sensor->threshold : 0;
    while (spot.range_m > builder->sensor->range_min_m + 1.5 && amplitude(builder, &spot) < wanted)
        spot.range_m *= 0.9;
    return spot;
}

static double sum_from(const struct builder *builder, const struct spot *spots, int count,
                       double range_m)
{
    double sum = 0;
    for (int i = 0; i < count; i++) {
        struct spot moved = spots[i];
        moved.range_m += range_m - spots[0].range_m;
        sum += amplitude(builder, &moved);
    }
    return sum;
}

/* Moves all points by one distance in range so that their amplitudes sum to wanted; false if no
 * range of the sensor does. Bisection ends at neighbouring doubles. */
static bool move_to_sum(const struct builder *builder, struct spot *spots, int count, double wanted)
{
    double near_m = elementary_max(builder->sensor->range_min_m, builder->sensor->range_floor_m) +
                    2 * builder->sensor->half_range_m;
    double far_m = builder->sensor->range_max_m - 2 * builder->sensor->half_range_m;
    if (sum_from(builder, spots, count, near_m) < wanted ||
        sum_from(builder, spots, count, far_m) > wanted)
        return false;
    double middle_m = near_m + (far_m - near_m) / 2;
    while (middle_m > near_m && middle_m < far_m) {
        bool strong = sum_from(builder, spots, count, middle_m) >= wanted;
        near_m = strong ? middle_m : near_m;
        far_m = strong ? far_m : middle_m;
        middle_m = near_m + (far_m - near_m) / 2;
    }
    double shift_m = near_m - spots[0].range_m;
    for (int i = 0; i < count; i++)
        spots[i].range_m += shift_m;
    return true;
}

static void build_threshold(struct builder *builder)
{
    struct spot spots[3] = {draw_spot(builder)};
    int count = (int)random_sequence_whole(&builder->sequence, 1, 3);
    for (int i = 1; i < count; i++) {
        spots[i] = draw_spot(builder);
        spots[i].range_m =
            spots[0].range_m +
            builder->sensor->half_range_m * random_sequence_between(&builder->sequence, -0.4, 0.4);
        spots[i].range_rate_mps = spots[0].range_rate_mps;
    }
    double first = builder->sensor->lowered_threshold;
    double wanted = (first > 0 ? first : builder->sensor->threshold) *
                    (1 + adversarial_traffic_margin(&builder->sequence, AMPLITUDE_MARGIN));
    for (int i = 0; i < 8 && !move_to_sum(builder, spots, count, wanted); i++)
        for (int k = 0; k < count; k++)
            spots[k].azimuth_rad /= 2;
    for (int i = 0; i < count; i++)
        add_spot(builder, &spots[i]);
}

/* Turns a point, on its side of boresight, until its amplitude is wanted; false if that is outside
 * the view. */
static bool turn_to_amplitude(const struct builder *builder, struct spot *spot, double wanted)
{
    struct spot turned = *spot;
    double side = copysign(1, spot->azimuth_rad), strong_rad = 0,
           weak_rad = antenna_border_rad(builder->sensor->field_of_view_rad);
    double middle_rad = weak_rad / 2;
    while (middle_rad > strong_rad && middle_rad < weak_rad) {
        turned.azimuth_rad = side * middle_rad;
        bool strong = amplitude(builder, &turned) >= wanted;
        strong_rad = strong ? middle_rad : strong_rad;
        weak_rad = strong ? weak_rad : middle_rad;
        middle_rad = strong_rad + (weak_rad - strong_rad) / 2;
    }
    if (strong_rad < 1e-3 ||
        strong_rad > 0.99 * antenna_border_rad(builder->sensor->field_of_view_rad))
        return false;
    spot->azimuth_rad = side * strong_rad;
    return true;
}

static void build_tie(struct builder *builder)
{
    struct spot first = draw_spot(builder), second = draw_spot(builder);
    double wanted = amplitude(builder, &first) *
                    (1 + adversarial_traffic_margin(&builder->sequence, AMPLITUDE_MARGIN));
    if (random_sequence_chance(&builder->sequence, 0.5)) {
        second.class = first.class;
        second.range_rate_mps = first.range_rate_mps;
        second.range_m = first.range_m + builder->sensor->half_range_m *
                                             random_sequence_between(&builder->sequence, -3, 3);
        if (!turn_to_amplitude(builder, &second, wanted))
            second.azimuth_rad = -first.azimuth_rad;
    }
    move_to_sum(builder, &second, 1, wanted);
    add_spot(builder, &first);
    add_spot(builder, &second);
}

/* A chain of points, each half a cell from the one before it. */
static void add_chain(struct builder *builder, double half_cell, bool in_rate)
{
    struct spot spot = draw_spot(builder);
    double beside = 1.9 * random_sequence_next(&builder->sequence) - 0.95;
    int count = (int)random_sequence_whole(&builder->sequence, 2, 3);
    add_spot(builder, &spot);
    for (int i = 1; i < count; i++) {
        double step =
            half_cell * (1 + adversarial_traffic_margin(&builder->sequence, SPACING_MARGIN));
        if (in_rate) {
            spot.range_rate_mps += step;
            spot.range_m += beside * builder->sensor->half_range_m;
        } else {
            spot.range_m += step;
            spot.range_rate_mps += beside * builder->sensor->half_range_rate_mps;
        }
        spot.azimuth_rad = draw_spot(builder).azimuth_rad;
        add_spot(builder, &spot);
    }
}

static void build_range(struct builder *builder)
{
    add_chain(builder, builder->sensor->half_range_m, false);
}

static void build_rate(struct builder *builder)
{
    add_chain(builder, builder->sensor->half_range_rate_mps, true);
}

static void build_symmetry(struct builder *builder)
{
    struct spot spot = draw_spot(builder);
    add_spot(builder, &spot);
    spot.azimuth_rad = -spot.azimuth_rad + adversarial_traffic_margin(&builder->sequence, 1e-9);
    add_spot(builder, &spot);
}

static void build_view(struct builder *builder)
{
    struct spot spot = draw_spot(builder);
    double margin_rad = adversarial_traffic_margin(&builder->sequence, 1e-7);
    bool border = random_sequence_chance(&builder->sequence, 0.6);
    spot.azimuth_rad =
        border ? copysign(antenna_border_rad(builder->sensor->field_of_view_rad), spot.azimuth_rad)
               : 0;
    spot.azimuth_rad += margin_rad;
    add_spot(builder, &spot);
}

static void build_reach(struct builder *builder)
{
    struct spot spot = draw_spot(builder);
    bool largest = random_sequence_chance(&builder->sequence, 0.5);
    spot.range_m = largest ? builder->sensor->range_max_m : builder->sensor->range_min_m;
    spot.range_m *= 1 + adversarial_traffic_margin(&builder->sequence, 1e-9);
    add_spot(builder, &spot);
}

/* A box whose front corner on that side (1 left) touches the line of sight to spot; its sides lie
 * beyond the corner. */
static void add_grazing_box(struct builder *builder, const struct spot *spot, double side)
{
    static const enum random_traffic_class classes[] = {TRAFFIC_CAR, TRAFFIC_VAN, TRAFFIC_BUS,
                                                        TRAFFIC_WALL};
    struct vec2 line = direction_to(builder, spot->azimuth_rad);
    double turned_rad = side * -PI / 2 * (1 + random_sequence_next(&builder->sequence));
    struct vec2 corner = place_at(builder, spot->range_m, spot->azimuth_rad);
    add_box(builder, classes[random_sequence_whole(&builder->sequence, 0, 3)],
            elementary_atan2(line.y, line.x) + turned_rad, 0.5, side * 0.5, corner);
}

static void build_grazing(struct builder *builder)
{
    struct spot spot = draw_spot(builder);
    double side = random_sequence_sign(&builder->sequence);
    add_grazing_box(builder, &spot, side);
    if (random_sequence_chance(&builder->sequence, 0.5)) {
        spot.range_m *= random_sequence_between(&builder->sequence, 1.05, 1.4);
        add_grazing_box(builder, &spot, -side);
    }
    spot.range_m *= random_sequence_between(&builder->sequence, 1.05, 1.5);
    spot.azimuth_rad += adversarial_traffic_margin(&builder->sequence, 1e-9);
    add_spot(builder, &spot);
}

/* A line of sight along x, with a side of a car on it exactly: all places keep the mount's y. */
static void build_along_side(struct builder *builder)
{
    struct vec2 mount = builder->pose.position_m;
    double side = mount.y > 0 ? 1 : -1;
    double ahead_m = random_sequence_between(&builder->sequence, 3, 20);
    struct vec2 centre = {mount.x + ahead_m, mount.y - side};
    struct object *car = add_object(builder, TRAFFIC_CAR, centre);
    car->length_m = 4;
    car->width_m = 2;
    struct vec2 behind = {centre.x + random_sequence_between(&builder->sequence, 2, 8), mount.y};
    int64_t step = random_sequence_whole(&builder->sequence, -1, 1);
    if (step != 0)
        behind.y = nextafter(behind.y, behind.y + (double)step);
    add_object(builder, draw_point_class(&builder->sequence), behind);
}

static void build_touch(struct builder *builder)
{
    const struct object *ego = &builder->frame->objects.items[0];
    bool exact = ego->x_m == 0 && ego->y_m == 0 && ego->yaw_rad == 0;
    if (exact &&
        fabs(builder->sensor->mount_yaw_rad) <
            antenna_border_rad(builder->sensor->field_of_view_rad) &&
        random_sequence_chance(&builder->sequence, 0.5))
        build_along_side(builder);
    else
        build_grazing(builder);
}

static void build_facing(struct builder *builder)
{
    const struct reflector_set *car = builder->models[TRAFFIC_CAR].reflectors;
    size_t which =
        (size_t)random_sequence_whole(&builder->sequence, 0, (int64_t)car->points.count - 1);
    const struct point_reflector *point = &car->points.items[which];
    struct spot spot = draw_spot(builder);
    struct vec2 line = direction_to(builder, spot.azimuth_rad);
    double edge_rad =
        random_sequence_chance(&builder->sequence, 0.5) ? point->full_rad : point->zero_rad;
    double off_rad = random_sequence_sign(&builder->sequence) *
                     (edge_rad + adversarial_traffic_margin(&builder->sequence, 1e-6));
    add_box(builder, TRAFFIC_CAR, elementary_atan2(-line.y, -line.x) - point->facing_rad - off_rad,
            point->x, point->y, place_at(builder, spot.range_m, spot.azimuth_rad));
}

static void build_foot(struct builder *builder)
{
    struct spot spot = draw_spot(builder);
    struct vec2 line = direction_to(builder, spot.azimuth_rad);
    struct vec2 aside =
        vec2_scale(adversarial_traffic_margin(&builder->sequence, 1e-9), vec2_left(line));
    struct vec2 end = vec2_add(place_at(builder, spot.range_m, spot.azimuth_rad), aside);
    add_box(builder, TRAFFIC_CAR, elementary_atan2(line.y, line.x), -0.5,
            random_sequence_sign(&builder->sequence) * 0.5, end);
}

static void build_against(struct builder *builder)
{
    struct spot spot = draw_spot(builder);
    struct vec2 line = direction_to(builder, spot.azimuth_rad);
    add_box(builder, TRAFFIC_CAR, elementary_atan2(line.y, line.x), -0.5,
            random_sequence_between(&builder->sequence, -0.4, 0.4),
            place_at(builder, spot.range_m, spot.azimuth_rad));
    spot.range_m += adversarial_traffic_margin(&builder->sequence, 1e-8);
    add_spot(builder, &spot);
}

static const struct {
    const char *name;
    void (*build)(struct builder *builder);
} cases[] = {
    {"threshold", build_threshold}, {"tie", build_tie},           {"range", build_range},
    {"rate", build_rate},           {"symmetry", build_symmetry}, {"view", build_view},
    {"reach", build_reach},         {"touch", build_touch},       {"facing", build_facing},
    {"foot", build_foot},           {"against", build_against},
};

static void build(struct builder *builder, const struct suite *suite)
{
    enum { LAST_CASE = sizeof cases / sizeof *cases - 1 };
    struct motion ego = frame_motion(&builder->frame->objects.items[0], 0);
    int64_t which = random_sequence_whole(&builder->sequence, 0, (int64_t)suite->sensors.count - 1);
    builder->sensor = &suite->sensors.items[which];
    builder->pose =
        kinematics_sensor_pose(&ego, builder->sensor->mount_x_m, builder->sensor->mount_y_m,
                               builder->sensor->mount_yaw_rad);
    int64_t chosen = random_sequence_whole(&builder->sequence, 0, LAST_CASE);
    builder->name = cases[chosen].name;
    cases[chosen].build(builder);
}

void adversarial_traffic_add(const struct random_traffic *traffic, const struct suite *suite,
                             int64_t number, struct frame *frame)
{
    struct random_address address = random_traffic_address(traffic, frame->seed, number);
    struct random_sequence sequence = random_sequence_at(address, ADVERSARIAL_TRAFFIC_DRAWS);
    int64_t count = random_sequence_whole(&sequence, 1, 3);
    for (int64_t i = 1; i <= count; i++) {
        address.item = (uint64_t)i;
        struct builder builder = {.frame = frame,
                                  .models = traffic->models,
                                  .sequence =
                                      random_sequence_at(address, ADVERSARIAL_TRAFFIC_DRAWS),
                                  .number = i};
        build(&builder, suite);
    }
}
