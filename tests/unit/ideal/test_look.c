#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/units.h"
#include "geometry/outline_crossing.h"
#include "ideal/direct_echoes.h"
#include "ideal/line_of_sight.h"
#include "sample.h"
#include "text/record_text.h"

/* A frame in which object "e" carries a sensor that looks over the half plane ahead. */
struct scene {
    struct arena arena;
    struct frame frame;
    struct sensor sensor;
};

static const struct selection everything = {.allowed = EFFECT_BIT(EFFECT_COUNT) - 1};
static const struct selection automatic = {.allowed = EFFECT_BIT(EFFECT_COUNT) - 1,
                                           .automatic = true};

static int make_scene(void **state)
{
    struct scene *scene = calloc(1, sizeof *scene);
    assert_non_null(scene);
    scene->frame =
        (struct frame){.scene = "s", .ego = "e", .time_s = 10, .interval_s = 1, .account = true};
    scene->frame.arena = &scene->arena;
    scene->sensor = (struct sensor){
        .name = "front", .range_max_m = 100, .field_of_view_rad = PI, .range_min_m = 0.1};
    *list_add(&scene->frame.objects, &scene->arena) =
        (struct object){.id = "e", .class = "car", .length_m = 4, .width_m = 2};
    *state = scene;
    return 0;
}

static int remove_scene(void **state)
{
    struct scene *scene = *state;
    arena_free(&scene->arena);
    free(scene);
    return 0;
}

static struct object *add_object(struct scene *scene, const char *id, double x_m, double y_m)
{
    struct object *object = list_add(&scene->frame.objects, &scene->arena);
    *object = (struct object){
        .id = id, .class = "car", .x_m = x_m, .y_m = y_m, .length_m = 4, .width_m = 2};
    return object;
}

static struct reflector_set *add_set(struct scene *scene, const char *object)
{
    struct reflector_set *set = list_add(&scene->frame.reflectors, &scene->arena);
    *set = (struct reflector_set){.model = object, .blocks = true};
    *list_add(&set->objects, &scene->arena) = object;
    return set;
}

static struct point_reflector *add_point(struct scene *scene, struct reflector_set *set)
{
    struct point_reflector *point = list_add(&set->points, &scene->arena);
    *point = (struct point_reflector){
        .name = "pole", .full_rad = PI, .zero_rad = PI, .shape = VISIBILITY_HARD, .ercs = 0.5};
    return point;
}

static struct look look_at(struct scene *scene, double time_s)
{
    struct look look;
    struct diag diag = {0};
    if (look_begin(&look, &scene->frame, &scene->sensor, &everything, time_s, &diag) != 0)
        fail_msg("%s", diag.text);
    direct_echoes_add(&look);
    return look;
}

/* The one loss of a frame with no echo. */
static const struct lost_group *only_loss(const struct scene *scene)
{
    assert_int_equal(scene->frame.echoes.count, 0);
    assert_int_equal(scene->frame.lost.count, 1);
    assert_int_equal(scene->frame.lost.items[0].echoes.count, 1);
    return &scene->frame.lost.items[0];
}

static void the_sensor_moves_with_the_lever_arm_of_a_turning_ego(void **state)
{
    struct scene *scene = *state;
    struct object *ego = scene->frame.objects.items;
    ego->x_m = 100;
    ego->y_m = 50;
    ego->yaw_rad = PI / 2;
    ego->vy_mps = 10;
    ego->yaw_rate_radps = 0.5;
    scene->sensor.mount_x_m = 2;
    scene->sensor.mount_y_m = -1;
    scene->sensor.mount_yaw_rad = -PI / 2;
    add_point(scene, add_set(scene, "a"));
    add_object(scene, "a", 111, 52);
    struct look look = look_at(scene, 10);
    /* Facing north: 2 m ahead is +y, 1 m to the right is +x; ω × (1, 2) = 0.5 (-2, 1). */
    assert_close(look.pose.position_m.x, 101, 1e-12);
    assert_close(look.pose.position_m.y, 52, 1e-12);
    assert_close(look.pose.velocity_mps.x, -1, 1e-12);
    assert_close(look.pose.velocity_mps.y, 10.5, 1e-12);
    assert_close(look.pose.boresight.x, 1, 1e-12);
    assert_close(look.pose.boresight.y, 0, 1e-12);
    const struct echo *echo = scene->frame.echoes.items;
    assert_int_equal(scene->frame.echoes.count, 1);
    assert_close(echo->range_m, 10, 1e-12);
    assert_close(echo->azimuth_rad, 0, 1e-12);
    assert_close(echo->range_rate_mps, 1, 1e-12);
    assert_close(echo->ercs, 0.5, 0);
}

static void a_late_measurement_shows_where_everything_was(void **state)
{
    struct scene *scene = *state;
    struct object *ego = scene->frame.objects.items;
    ego->vx_mps = 20;
    add_point(scene, add_set(scene, "a"));
    add_point(scene, add_set(scene, "b"))->x = 0.5;
    struct object *straight = add_object(scene, "a", 30, 0);
    straight->vx_mps = -5;
    /* On a circle about (40, 0) with radius 10: a quarter turn earlier it was at its bottom. */
    struct object *turning = add_object(scene, "b", 50, 0);
    turning->vy_mps = 10;
    turning->yaw_rad = PI / 2;
    turning->yaw_rate_radps = 1;
    double age_s = PI / 2;
    look_at(scene, 10 - age_s);
    const struct echo *echo = scene->frame.echoes.items;
    assert_int_equal(scene->frame.echoes.count, 2);
    assert_string_equal(echo[0].id.object, "a");
    assert_close(echo[0].range_m, 30 + 5 * age_s + 20 * age_s, 1e-9);
    assert_close(echo[0].range_rate_mps, -25, 1e-9);
    assert_close(echo[0].time_s, 10 - age_s, 0);
    /* The front of b was 2 m ahead of (40, -10), where b headed along +x. */
    double x = 40 + 2 + 20 * age_s, y = -10;
    assert_close(echo[1].range_m, hypot(x, y), 1e-9);
    assert_close(echo[1].azimuth_rad, atan2(y, x), 1e-12);
    /* Velocity of the front then: (10, 0) + 1 × (2, 0) = (10, 2); the sensor's is (20, 0). */
    assert_close(echo[1].range_rate_mps, (-10 * x + 2 * y) / hypot(x, y), 1e-9);
}

static void the_first_blocker_by_id_is_named(void **state)
{
    struct scene *scene = *state;
    add_point(scene, add_set(scene, "far"))->ercs = 1;
    add_set(scene, "y");
    add_set(scene, "x");
    add_set(scene, "w")->blocks = false;
    add_object(scene, "far", 40, 0);
    add_object(scene, "y", 10, 0);
    add_object(scene, "x", 20, 0);
    add_object(scene, "w", 30, 0);
    struct look look = look_at(scene, 10);
    const struct lost_group *lost = only_loss(scene);
    assert_int_equal(lost->reason, LOSS_BLOCKED);
    assert_string_equal(lost->stage, "ideal");
    assert_string_equal(lost->sensor, "front");
    assert_string_equal(lost->echoes.items[0].id.object, "far");
    assert_string_equal(lost->echoes.items[0].by, "x");
    assert_int_equal(look.pairs, 1);
    assert_int_equal(scene->frame.counts.items[0].pairs, 1);
    assert_int_equal(scene->frame.counts.items[0].paths.items[0].echoes, 0);
}

static void an_object_does_not_block_itself_and_the_ego_blocks_nothing(void **state)
{
    struct scene *scene = *state;
    struct reflector_set *set = add_set(scene, "a");
    add_point(scene, set)->x = 0.5; /* the far end */
    add_object(scene, "a", 20, 0);
    scene->sensor.mount_x_m = -2; /* looks through its own car */
    look_at(scene, 10);
    assert_int_equal(scene->frame.echoes.count, 1);
    assert_close(scene->frame.echoes.items[0].range_m, 24, 1e-12);
}

static void wheel_houses_are_seen_under_raised_vehicles_only(void **state)
{
    struct scene *scene = *state;
    struct reflector_set *set = add_set(scene, "far");
    add_point(scene, set)->name = "corner";
    struct point_reflector *wheel = add_point(scene, set);
    wheel->name = "wheel";
    wheel->under_vehicles = 0.5;
    add_set(scene, "truck")->raised = true;
    add_object(scene, "far", 40, 0);
    struct object *truck = add_object(scene, "truck", 20, 0);
    look_at(scene, 10);
    assert_int_equal(scene->frame.echoes.count, 1);
    assert_string_equal(scene->frame.echoes.items[0].id.reflector, "wheel");
    assert_close(scene->frame.echoes.items[0].ercs, 0.25, 0);
    assert_string_equal(scene->frame.lost.items[0].echoes.items[0].id.reflector, "corner");
    assert_string_equal(scene->frame.lost.items[0].echoes.items[0].by, "truck");
    /* Behind a wall both are lost; without wall and truck both have their full ERCS. */
    add_set(scene, "wall");
    struct object *wall = add_object(scene, "wall", 30, 0);
    scene->frame.echoes.count = 0;
    look_at(scene, 10);
    assert_int_equal(scene->frame.echoes.count, 0);
    wall->y_m = 20;
    truck = &scene->frame.objects.items[2];
    truck->y_m = 20;
    look_at(scene, 10);
    assert_int_equal(scene->frame.echoes.count, 2);
    assert_close(scene->frame.echoes.items[1].ercs, 0.5, 0);
}

static void every_loss_has_its_reason(void **state)
{
    (void)state;
    static const struct {
        double x_m, y_m, facing_rad;
        enum loss reason;
    } cases[] = {{50, 0, 0, LOSS_FACING_AWAY},     {100.1, 0, PI, LOSS_OUT_OF_RANGE},
                 {0.05, 0, PI, LOSS_OUT_OF_RANGE}, {10, 10.001, -3 * PI / 4, LOSS_OUT_OF_VIEW},
                 {-10, 0, 0, LOSS_OUT_OF_VIEW},    {0, 0, 0, LOSS_OUT_OF_RANGE},
                 {500, 0, 0, LOSS_FACING_AWAY}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        void *place;
        make_scene(&place);
        struct scene *scene = place;
        scene->sensor.field_of_view_rad = PI / 2;
        struct point_reflector *point = add_point(scene, add_set(scene, "a"));
        point->facing_rad = cases[i].facing_rad;
        point->zero_rad = 1;
        add_object(scene, "a", cases[i].x_m, cases[i].y_m);
        look_at(scene, 10);
        assert_int_equal(only_loss(scene)->reason, cases[i].reason);
        remove_scene(&place);
    }
}

static void planes_mirror_from_the_foot_of_the_perpendicular(void **state)
{
    struct scene *scene = *state;
    struct reflector_set *set = add_set(scene, "a");
    *list_add(&set->planes, &scene->arena) = (struct plane_reflector){
        .name = "rear", .from_x = -0.5, .from_y = 0.5, .to_x = -0.5, .to_y = -0.5, .ercs = 0.7};
    struct object *car = add_object(scene, "a", 20, 0.9);
    look_at(scene, 10);
    assert_int_equal(scene->frame.echoes.count, 1);
    assert_close(scene->frame.echoes.items[0].range_m, 18, 1e-12);
    assert_close(scene->frame.echoes.items[0].azimuth_rad, 0, 1e-12);
    scene->frame.echoes.count = 0;
    car = &scene->frame.objects.items[1];
    car->y_m = 1.1;
    look_at(scene, 10);
    assert_int_equal(only_loss(scene)->reason, LOSS_NO_SPECULAR);
}

/* Two walls of 4 m in line, with the sensor exactly before their joint, then an ulp to either side.
 */
static void the_joint_of_two_walls_mirrors_once(void **state)
{
    struct scene *scene = *state;
    struct reflector_set *set = add_set(scene, "a");
    *list_add(&set->objects, &scene->arena) = "b";
    *list_add(&set->planes, &scene->arena) = (struct plane_reflector){
        .name = "right", .from_x = -0.5, .from_y = -0.5, .to_x = 0.5, .to_y = -0.5, .ercs = 1};
    add_object(scene, "a", 8, 21);
    add_object(scene, "b", 12, 21);
    scene->sensor.mount_yaw_rad = PI / 2;
    static const double sensor_x_m[] = {10, 10 - 0x1p-49, 10 + 0x1p-49};
    static const char *const owner[] = {"b", "a", "b"};
    for (int i = 0; i < 3; i++) {
        scene->frame.objects.items[0].x_m = sensor_x_m[i];
        scene->frame.echoes.count = 0;
        look_at(scene, 10);
        assert_int_equal(scene->frame.echoes.count, 1);
        assert_string_equal(scene->frame.echoes.items[0].id.object, owner[i]);
        assert_close(scene->frame.echoes.items[0].range_m, 20, 0);
    }
}

/* A lobe 60 degrees wide across and 40 upright, with its middle level, at most 20 dB deep. */
static double lobe_of(double off_degrees, double below_degrees)
{
    double across_db = 12 * (off_degrees / 60) * (off_degrees / 60);
    double upright_db = 12 * (below_degrees / 40) * (below_degrees / 40);
    return pow(10, -fmin(across_db + upright_db, 20) / 20);
}

static void a_lobe_depends_on_direction_and_height_of_the_sensor(void **state)
{
    struct scene *scene = *state;
    struct object *object = add_object(scene, "o", 10, 0);
    struct point_reflector *point = add_point(scene, add_set(scene, "o"));
    point->z = 1;
    point->lobe = (struct lobe){60 * PI / 180, PI / 2, 40 * PI / 180, 20};
    static const double turned_degrees[] = {180, 165, 200, 0};
    for (size_t i = 0; i < 4; i++) {
        scene->frame.echoes.count = 0;
        object->yaw_rad = turned_degrees[i] * PI / 180;
        look_at(scene, 10);
        const struct echo *echo = scene->frame.echoes.items;
        assert_near(echo->ercs, 0.5 * lobe_of(turned_degrees[i] - 180, 0), 1e-12);
        assert_true(((echo->effects & EFFECT_BIT(EFFECT_VISIBILITY)) != 0) ==
                    (turned_degrees[i] != 180));
    }
    object->yaw_rad = PI;
    object->height_m = 0.5;
    scene->sensor.mount_z_m = 0.5 + 10 * tan(10 * PI / 180);
    scene->frame.echoes.count = 0;
    look_at(scene, 10);
    assert_near(scene->frame.echoes.items->ercs, 0.5 * lobe_of(0, 10), 1e-12);
}

static void rows_are_expanded_in_range_and_no_post_is_missed(void **state)
{
    (void)state;
    uint64_t random = 6;
    for (int i = 0; i < 20000; i++) {
        struct box box = {.motion.position_m = {sample_between(&random, -50, 50),
                                                sample_between(&random, -50, 50)},
                          .heading = vec2_heading(sample_between(&random, -4, 4)),
                          .length_m = sample_between(&random, 0, i % 7 ? 300 : 0.1),
                          .width_m = sample_between(&random, 0, 5)};
        struct post_row row = {.from_x = sample_between(&random, -1, 1),
                               .from_y = sample_between(&random, -1, 1),
                               .to_x = sample_between(&random, -1, 1),
                               .to_y = sample_between(&random, -1, 1),
                               .spacing_m = i % 5 ? sample_between(&random, 0.5, 20) : 4};
        if (i % 11 == 0)
            row.to_x = row.from_x, row.to_y = row.from_y;
        struct vec2 sensor = {sample_between(&random, -200, 200), sample_between(&random, -9, 9)};
        double range_m = sample_between(&random, 0, 120);
        double length_m = vec2_length(
            vec2_sub(box_place(&box, row.to_x, row.to_y), box_place(&box, row.from_x, row.from_y)));
        int64_t posts = 1 + (int64_t)floor(length_m / row.spacing_m), first, end, within = 0;
        reflectors_posts_within(&box, &row, sensor, range_m, &first, &end);
        assert_true(0 <= first && first <= posts && end <= posts + 1);
        for (int64_t post = 0; post < posts; post++) {
            struct vec2 place = reflectors_post_place(&box, &row, post);
            bool in_range = vec2_length(vec2_sub(place, sensor)) <= range_m;
            within += in_range;
            if (in_range)
                assert_true(first <= post && post < end);
        }
        assert_true(end - first <= within + 2 || length_m == 0);
    }
}

static void posts_become_echoes_with_their_numbers(void **state)
{
    struct scene *scene = *state;
    struct reflector_set *set = add_set(scene, "rail");
    set->blocks = false;
    *list_add(&set->rows, &scene->arena) = (struct post_row){.name = "post",
                                                             .from_x = -0.5,
                                                             .to_x = 0.5,
                                                             .spacing_m = 4,
                                                             .full_rad = PI,
                                                             .zero_rad = PI,
                                                             .shape = VISIBILITY_HARD,
                                                             .ercs = 0.2};
    struct object *rail = add_object(scene, "rail", 0, 5);
    rail->length_m = 400;
    struct look look = look_at(scene, 10);
    /* Posts at x = -200 + 4 n; those ahead within 100 m: x = 4 to 96, n = 51 to 74. */
    assert_int_equal(scene->frame.echoes.count, 24);
    for (int i = 0; i < 24; i++) {
        char name[24];
        snprintf(name, sizeof name, "post_%d", 51 + i);
        assert_string_equal(scene->frame.echoes.items[i].id.reflector, name);
        assert_close(scene->frame.echoes.items[i].range_m, hypot(4 + 4 * i, 5), 1e-9);
    }
    /* Those behind, x = -96 to 0, are out of view, those at x = -100 and 100 out of range. */
    assert_in_range(look.pairs, 49, 51);
    size_t lost = 0;
    for (size_t i = 0; i < scene->frame.lost.count; i++)
        lost += scene->frame.lost.items[i].echoes.count;
    assert_int_equal(lost + 24, look.pairs);
    assert_int_equal(look.echoes, 24);
}

/* The margins of the only entry, echo or loss. */
static struct margins only_margins(const struct scene *scene)
{
    return scene->frame.echoes.count == 1 ? scene->frame.echoes.items[0].margins
                                          : only_loss(scene)->echoes.items[0].margins;
}

/* A pole at (x, y) that is seen within 1 rad of -x, a sensor at (0, 0) that sees from 1 to 100 m
 * and 45 degrees to either side, and, if box_x is not 0, a box of 4 m by 2 m at (box_x, 0). */
static void a_margin_is_the_distance_from_another_answer(void **state)
{
    (void)state;
    static const struct {
        double x_m, y_m, box_x_m;
        int reason; /* -1: seen */
        double margin_m;
    } cases[] = {
        {3, 0, 0, -1, 2},      /* nearest limit */
        {99.5, 0, 0, -1, 0.5}, /* farthest limit */
        {0.75, 0, 0, LOSS_OUT_OF_RANGE, 0.25},
        {102, 0, 0, LOSS_OUT_OF_RANGE, 2},
        {40, 39, 0, -1, 1},                 /* worked out below */
        {39, 40, 0, LOSS_OUT_OF_VIEW, 1},   /* below, too */
        {-10, 0, 0, LOSS_FACING_AWAY, 0},   /* below */
        {60, 3, 30, -1, 2},                 /* below */
        {60, 0, 30, LOSS_BLOCKED, 1},       /* the box reaches 1 m to either side */
        {28.25, 0, 30, LOSS_BLOCKED, 0.25}, /* 0.25 m behind its rear at 28 m */
        {27.5, 0, 30, -1, 0.5},             /* 0.5 m before it */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        void *place;
        make_scene(&place);
        struct scene *scene = place;
        scene->frame.margins = true;
        scene->sensor.field_of_view_rad = PI / 2;
        scene->sensor.range_min_m = 1;
        struct point_reflector *pole = add_point(scene, add_set(scene, "pole"));
        pole->facing_rad = PI;
        pole->zero_rad = 1;
        add_object(scene, "pole", cases[i].x_m, cases[i].y_m);
        if (cases[i].box_x_m > 0) {
            add_set(scene, "box");
            add_object(scene, "box", cases[i].box_x_m, 0);
        }
        look_at(scene, 10);
        double azimuth = fabs(atan2(cases[i].y_m, cases[i].x_m));
        double range_m = hypot(cases[i].x_m, cases[i].y_m), margin_m = cases[i].margin_m;
        if (cases[i].reason == LOSS_FACING_AWAY)
            margin_m = range_m * (azimuth - 1);
        else if (azimuth > PI / 5)
            margin_m = range_m * fabs(azimuth - (PI / 4 - 1e-9));
        else if (cases[i].y_m == 3) /* the sight line passes the near left corner (28, 1) */
            margin_m = (28 * 3 - 60) / range_m;
        if (cases[i].reason >= 0)
            assert_int_equal(only_loss(scene)->reason, cases[i].reason);
        struct margins margins = only_margins(scene);
        assert_int_equal(margins.present, MARGIN_SIGHT);
        assert_close(margins.sight_m, margin_m, 1e-12);
        remove_scene(&place);
    }
}

static void an_echo_from_under_a_truck_can_change_in_two_ways(void **state)
{
    (void)state;
    static const struct {
        double truck_y_m, wall_y_m, margin_m;
    } cases[] = {
        {0.5, 9, 0.5},   /* the line runs under the truck, 0.5 m from its side */
        {0, 1.25, 0.25}, /* the line passes the wall at 0.25 m */
        {-1.5, 3, 0.5},  /* the line passes the truck at 0.5 m */
        {0, 0.75, 0.25}, /* the wall blocks the line, 0.25 m deep */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        void *place;
        make_scene(&place);
        struct scene *scene = place;
        scene->frame.margins = true;
        add_point(scene, add_set(scene, "pole"))->under_vehicles = 0.5;
        add_set(scene, "truck")->raised = true;
        add_set(scene, "wall");
        add_object(scene, "pole", 50, 0);
        add_object(scene, "truck", 20, cases[i].truck_y_m);
        add_object(scene, "wall", 30, cases[i].wall_y_m);
        look_at(scene, 10);
        assert_close(only_margins(scene).sight_m, cases[i].margin_m, 1e-12);
        remove_scene(&place);
    }
}

static void the_margin_of_a_plane_is_the_distance_of_its_foot_from_an_end(void **state)
{
    struct scene *scene = *state;
    scene->frame.margins = true;
    struct reflector_set *set = add_set(scene, "a");
    *list_add(&set->planes, &scene->arena) = (struct plane_reflector){
        .name = "rear", .from_x = -0.5, .from_y = 0.5, .to_x = -0.5, .to_y = -0.5, .ercs = 0.7};
    struct object *car = add_object(scene, "a", 20, 0.75);
    look_at(scene, 10);
    assert_close(only_margins(scene).sight_m, 0.25, 1e-12);
    scene->frame.echoes.count = 0;
    car->y_m = 1.5;
    look_at(scene, 10);
    assert_int_equal(only_loss(scene)->reason, LOSS_NO_SPECULAR);
    assert_close(only_margins(scene).sight_m, 0.5, 1e-12);
}

static void without_margins_no_entry_has_any(void **state)
{
    struct scene *scene = *state;
    add_point(scene, add_set(scene, "a"));
    add_point(scene, add_set(scene, "b"))->zero_rad = 1;
    add_object(scene, "a", 20, 0);
    add_object(scene, "b", 0, 20);
    look_at(scene, 10);
    assert_int_equal(scene->frame.echoes.items[0].margins.present, 0);
    assert_int_equal(scene->frame.lost.items[0].echoes.items[0].margins.present, 0);
}

static void a_set_that_lists_an_unknown_object_is_refused(void **state)
{
    struct scene *scene = *state;
    struct look look;
    struct diag diag = {0};
    add_set(scene, "ghost");
    assert_int_equal(look_begin(&look, &scene->frame, &scene->sensor, &everything, 10, &diag), -1);
    assert_string_equal(diag.text, "reflectors[0].objects[0]: \"ghost\" is not among the objects, "
                                   "or is the ego");
}

/* Adds bodies of all heights around the sensor, which overlap and stand at the borders of its range
 * and view. */
static void add_random_bodies(struct scene *scene, uint64_t *random)
{
    static const char *const ids[] = {"a", "b", "c", "d", "f", "g", "h", "i", "j", "k", "l",
                                      "m", "n", "o", "p", "q", "r", "s", "t", "u", "v", "w"};
    struct sensor *sensor = &scene->sensor;
    sensor->mount_yaw_rad = sample_between(random, -PI, PI);
    sensor->field_of_view_rad = sample_between(random, 0.1, sample_bits(random) % 2 ? 2 * PI : 1);
    sensor->mount_z_m = sample_bits(random) % 2 ? sample_between(random, 0.2, 2) : 0;
    sensor->diffraction = sample_bits(random) % 4 == 0;
    sensor->carrier_hz = 24e9;
    double spread_m = sample_bits(random) % 2 ? 20 : 120;
    for (size_t i = 0; i < sizeof ids / sizeof ids[0]; i++) {
        struct reflector_set *set = add_set(scene, ids[i]);
        set->blocks = i % 4 != 0;
        set->raised = sample_bits(random) % 4 == 0;
        struct point_reflector *pole = add_point(scene, set);
        pole->under_vehicles = sample_bits(random) % 4 == 0 ? 0.5 : 0;
        double reach = sample_bits(random) % 2 ? 0.5 : 1;
        pole->x = sample_between(random, -reach, reach);
        pole->y = sample_between(random, -reach, reach);
        pole->z = sample_bits(random) % 2 ? 0 : sample_between(random, 0.1, 2);
        pole->facing_rad = sample_between(random, -PI, PI);
        pole->zero_rad = sample_between(random, 0, PI);
        pole->inset_m = i % 3 == 0 ? sample_between(random, 0, 8) : 0;
        *list_add(&set->planes, &scene->arena) =
            (struct plane_reflector){.name = "side",
                                     .from_x = 0.5,
                                     .from_y = 0.5,
                                     .to_x = -0.5,
                                     .to_y = 0.5,
                                     .margin_m = i % 2 == 0 ? 0.2 : 0,
                                     .ercs = 0.8};
        struct object *object = add_object(scene, ids[i], sample_between(random, -1, 1) * spread_m,
                                           sample_between(random, -1, 1) * spread_m);
        object->yaw_rad = sample_between(random, -PI, PI);
        object->height_m = sample_between(random, 0.3, 4);
    }
}

/* Compares echoes as text, because the padding between members has no value. */
static void assert_same_echoes(const struct echo *one, const struct echo *other, size_t count)
{
    const struct record *record = field_find(&frame_record, "echoes", strlen("echoes"), 0)->record;
    struct text texts[2] = {0};
    for (size_t i = 0; i < count; i++) {
        record_text_write(record, &one[i], NULL, &texts[0]);
        record_text_write(record, &other[i], NULL, &texts[1]);
    }
    assert_int_equal(texts[0].length, texts[1].length);
    if (count > 0)
        assert_memory_equal(texts[0].bytes, texts[1].bytes, texts[0].length);
    text_free(&texts[0]);
    text_free(&texts[1]);
}

static void auto_without_an_account_finds_the_same_echoes(void **state)
{
    (void)state;
    uint64_t random = 5;
    size_t echoes = 0, pairs = 0;
    for (int i = 0; i < 3000; i++) {
        void *place;
        make_scene(&place);
        struct scene *scene = place;
        add_random_bodies(scene, &random);
        struct look all = look_at(scene, 10), some;
        struct frame *frame = &scene->frame, accounted = *frame;
        frame->account = false;
        memset(&frame->echoes, 0, sizeof frame->echoes);
        assert_int_equal(look_begin(&some, frame, &scene->sensor, &automatic, 10, NULL), 0);
        direct_echoes_add(&some);
        assert_int_equal(some.pairs, all.pairs);
        assert_int_equal(some.echoes, all.echoes);
        assert_same_echoes(frame->echoes.items, accounted.echoes.items, (size_t)some.echoes);
        echoes += (size_t)all.echoes;
        pairs += (size_t)all.pairs;
        remove_scene(&place);
    }
    assert_true(echoes > 5000 && pairs > 100000);
}

/* A side that stands out of its body's box, in line with the side of a wall behind that body. */
static void a_body_hides_nothing_of_a_wall_that_it_joins(void **state)
{
    struct scene *scene = *state;
    struct reflector_set *wall = add_set(scene, "wall"), *front = add_set(scene, "front");
    *list_add(&wall->planes, &scene->arena) = (struct plane_reflector){
        .name = "right", .from_x = -0.5, .from_y = -0.5, .to_x = 0.5, .to_y = -0.5, .ercs = 1};
    *list_add(&front->planes, &scene->arena) = (struct plane_reflector){
        .name = "out", .from_x = 0.25, .from_y = 4 / 6.0, .to_x = 0.75, .to_y = 4 / 6.0, .ercs = 1};
    struct object *object = add_object(scene, "wall", 0, 10.5);
    object->length_m = 2;
    object->width_m = 1;
    add_object(scene, "front", 0, 6)->width_m = 6;
    scene->sensor.mount_yaw_rad = PI / 2;
    for (int joined = 1; joined >= 0; joined--) {
        scene->frame.echoes.count = 0;
        scene->frame.account = false;
        front->planes.count = (size_t)joined;
        struct look look;
        assert_int_equal(look_begin(&look, &scene->frame, &scene->sensor, &automatic, 10, NULL), 0);
        direct_echoes_add(&look);
        assert_int_equal(look.echoes, joined);
    }
}

/* Circles around and within bodies decide most lines; the exact test must agree on all. */
static void a_line_is_blocked_where_it_touches_an_outline(void **state)
{
    (void)state;
    uint64_t random = 11;
    size_t blocked = 0, lines = 0;
    for (int i = 0; i < 2000; i++) {
        void *place;
        make_scene(&place);
        struct scene *scene = place;
        add_random_bodies(scene, &random);
        scene->sensor.mount_z_m = 0;
        scene->sensor.diffraction = false;
        struct look look = look_at(scene, 10);
        for (int k = 0; k < 50; k++) {
            struct vec2 far = {sample_between(&random, -60, 60), sample_between(&random, -60, 60)};
            const struct obstruction_line line = {.from = look.pose.position_m, .to = far};
            const struct look_body *by = NULL;
            for (size_t j = look.body_count; j-- > 0;)
                if (look.bodies[j].blocks &&
                    outline_crossing_blocks(look.bodies[j].corner, 4, line.from, line.to))
                    by = &look.bodies[j];
            struct line_of_sight found = line_of_sight_along(&look, &line, NULL, 0);
            assert_ptr_equal(found.by, by);
            assert_true(found.factor == (by == NULL));
            blocked += by != NULL;
            lines++;
        }
        remove_scene(&place);
    }
    assert_true(blocked > lines / 10 && blocked < lines / 2);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_scene, remove_scene)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(the_sensor_moves_with_the_lever_arm_of_a_turning_ego),
        TEST(a_late_measurement_shows_where_everything_was),
        TEST(the_first_blocker_by_id_is_named),
        TEST(an_object_does_not_block_itself_and_the_ego_blocks_nothing),
        TEST(wheel_houses_are_seen_under_raised_vehicles_only),
        TEST(every_loss_has_its_reason),
        TEST(planes_mirror_from_the_foot_of_the_perpendicular),
        TEST(the_joint_of_two_walls_mirrors_once),
        TEST(a_lobe_depends_on_direction_and_height_of_the_sensor),
        TEST(rows_are_expanded_in_range_and_no_post_is_missed),
        TEST(posts_become_echoes_with_their_numbers),
        TEST(a_margin_is_the_distance_from_another_answer),
        TEST(an_echo_from_under_a_truck_can_change_in_two_ways),
        TEST(the_margin_of_a_plane_is_the_distance_of_its_foot_from_an_end),
        TEST(without_margins_no_entry_has_any),
        TEST(a_set_that_lists_an_unknown_object_is_refused),
        TEST(auto_without_an_account_finds_the_same_echoes),
        TEST(a_body_hides_nothing_of_a_wall_that_it_joins),
        TEST(a_line_is_blocked_where_it_touches_an_outline),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
