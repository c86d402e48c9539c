#include "support/look_scene.h"

#include "frame/frame_order.h"
#include "geometry/obstruction.h"
#include "ideal/roadside_echoes.h"

/* A rail and a meadow along x, and a rail across. */
static void add_roadside(struct scene *scene)
{
    static const struct roadside_strip strips[] = {
        {.kind = ROADSIDE_RAIL,
         .from_x_m = -200,
         .from_y_m = 6,
         .to_x_m = 300,
         .to_y_m = 6,
         .spacing_m = 4,
         .rcs_dbsm = -8,
         .spread_db = 9},
        {.kind = ROADSIDE_VEGETATION,
         .from_x_m = -200,
         .from_y_m = -15,
         .to_x_m = 300,
         .to_y_m = -15,
         .width_m = 14,
         .per_m2 = 0.05,
         .rcs_dbsm = -20,
         .spread_db = 9},
        {.kind = ROADSIDE_RAIL,
         .from_x_m = 60,
         .from_y_m = -40,
         .to_x_m = 55,
         .to_y_m = 40,
         .spacing_m = 3,
         .rcs_dbsm = -8,
         .spread_db = 9},
    };
    for (size_t i = 0; i < COUNT(strips); i++)
        *list_add(&scene->frame.roadside, check_arena()) = strips[i];
    scene->sensor.carrier_hz = 77e9;
    scene->sensor.threshold_db = 6;
    scene->sensor.calibration_ercs = 0.2;
    scene->sensor.calibration_range_m = 60;
    scene->sensor.exponent = 2;
    scene->sensor.range_floor_m = 0.5;
    suite_derive(&scene->sensor);
}

/* The echoes that a selection makes now, by number, in a list that stays. */
static struct echo_span see_as(struct scene *scene, const struct selection *selection,
                               struct look *look)
{
    struct diag diag = {0};
    size_t before = scene->frame.echoes.count;
    if (look_begin(look, &scene->frame, &scene->sensor, selection, scene->frame.time_s, &diag) != 0)
        fail_msg("%s", diag.text);
    roadside_echoes_add(look);
    size_t count = scene->frame.echoes.count - before;
    struct echo *copy = arena_get(check_arena(), (count + 1) * sizeof *copy);
    for (size_t i = 0; i < count; i++)
        copy[i] = scene->frame.echoes.items[before + i];
    return (struct echo_span){copy, count};
}

static const struct echo *find(struct echo_span echoes, const struct echo *wanted)
{
    for (size_t i = 0; i < echoes.count; i++)
        if (frame_order_echo_ids(&echoes.items[i].id, &wanted->id) == 0)
            return &echoes.items[i];
    return NULL;
}

/* Two runs keep a name in two places. */
static void assert_same(const struct echo *echo, const struct echo *other)
{
    struct echo named = *echo;
    assert_int_equal(frame_order_echo_ids(&echo->id, &other->id), 0);
    named.id = other->id;
    assert_memory_equal(&named, other, sizeof named);
}

static struct vec2 world_place(const struct look *look, const struct echo *echo)
{
    struct vec2 ray = vec2_turn(vec2_heading(echo->azimuth_rad), look->pose.boresight);
    return vec2_add(look->pose.position_m, vec2_scale(echo->range_m, ray));
}

SCENE_TEST(the_same_scatterer_stays_in_the_world)
{
    struct look first, second;
    add_roadside(scene);
    struct echo_span before = see_as(scene, &automatic, &first);
    struct object *ego = frame_object(&scene->frame, "e");
    scene->frame.frame = 9;
    scene->frame.time_s = 10.4;
    scene->sensor.name = "corner";
    scene->sensor.mount_x_m = 2;
    scene->sensor.mount_y_m = 1;
    scene->sensor.mount_yaw_rad = 0.3;
    ego->x_m = 12;
    ego->y_m = 1;
    ego->yaw_rad = 0.1;
    struct echo_span after = see_as(scene, &automatic, &second);
    int same = 0;
    for (size_t i = 0; i < before.count; i++) {
        const struct echo *again = find(after, &before.items[i]);
        if (again == NULL)
            continue;
        struct vec2 was = world_place(&first, &before.items[i]);
        struct vec2 is = world_place(&second, again);
        assert_close(is.x, was.x, 1e-9);
        assert_close(is.y, was.y, 1e-9);
        same++;
    }
    assert_in_range(before.count, 60, 400);
    assert_true(same > (int)before.count / 2);
}

SCENE_TEST(scatterers_stand_and_have_labels_of_their_own)
{
    struct look look;
    add_roadside(scene);
    struct object *ego = frame_object(&scene->frame, "e");
    ego->vx_mps = 20;
    ego->vy_mps = 1;
    struct echo_span echoes = see_as(scene, &automatic, &look);
    for (size_t i = 0; i < echoes.count; i++) {
        const struct echo *echo = &echoes.items[i];
        assert_close(echo->range_rate_mps,
                     -20 * cos(echo->azimuth_rad) - 1 * sin(echo->azimuth_rad), 1e-9);
        assert_string_equal(echo->id.object, "roadside");
        assert_int_equal(echo->id.path, PATH_CLUTTER);
        assert_true(echo->effects == EFFECT_BIT(EFFECT_ROADSIDE));
        for (size_t j = 0; j < i; j++)
            assert_true(frame_order_echo_ids(&echoes.items[j].id, &echo->id) != 0);
    }
    assert_int_equal(frame_counted_echoes(&scene->frame.counts.items[0], PATH_CLUTTER),
                     echoes.count);
}

/* Their middle is at half the height of the strip's top. Places in the plane have d cos(elevation).
 */
SCENE_TEST(scatterers_have_the_elevation_of_their_middle)
{
    struct look look;
    add_roadside(scene);
    for (size_t i = 0; i < scene->frame.roadside.count; i++)
        scene->frame.roadside.items[i].height_m = 3;
    scene->sensor.mount_z_m = 0.5;
    scene->sensor.elevation_view_rad = 0.6;
    struct echo_span echoes = see_as(scene, &automatic, &look);
    assert_true(echoes.count > 60);
    for (size_t i = 0; i < echoes.count; i++)
        assert_near(sin(echoes.items[i].elevation_rad), 1 / echoes.items[i].range_m, 1e-12);
}

/* A rail out of sight, before all others in the list, changes nothing but the numbers in the names.
 */
SCENE_TEST(a_strip_out_of_sight_changes_no_echo_of_another_strip)
{
    struct look look;
    add_roadside(scene);
    scene->frame.roadside.items[0].id = "left";
    scene->frame.roadside.items[1].id = "right";
    scene->frame.roadside.items[2].id = "across";
    struct echo_span alone = see_as(scene, &automatic, &look);
    struct roadside_strip first = scene->frame.roadside.items[0], far = first;
    far.id = "far";
    far.from_y_m = far.to_y_m = 3000;
    *list_add(&scene->frame.roadside, check_arena()) = first;
    scene->frame.roadside.items[0] = far;
    struct echo_span beside = see_as(scene, &automatic, &look);
    assert_int_equal(alone.count, beside.count);
    for (size_t i = 0; i < alone.count; i++)
        assert_same(find(beside, &alone.items[i]), &alone.items[i]);
}

/* A car 20 m ahead, 4 m by 2 m, between the sensor and the cross rail. */
SCENE_TEST(a_body_hides_what_stands_behind_it)
{
    struct look look;
    add_roadside(scene);
    struct echo_span open = see_as(scene, &automatic, &look);
    add_object(scene, "car", 20, 0);
    add_set(scene, "car");
    struct echo_span behind = see_as(scene, &automatic, &look);
    int hidden = 0;
    for (size_t i = 0; i < open.count; i++) {
        struct vec2 place = world_place(&look, &open.items[i]);
        bool blocked = obstruction_blocks(look.bodies[0].corner, 4, (struct vec2){0, 0}, place);
        assert_true(blocked == (find(behind, &open.items[i]) == NULL));
        hidden += blocked;
    }
    assert_int_equal(open.count - behind.count, hidden);
    assert_true(hidden > 1);
}

/* 9 dB more of threshold leave out what is weaker by that much, and change no other echo. The
 * weakest is 14 dB below the threshold, but for the way from it to the middle of its cell. */
SCENE_TEST(a_higher_threshold_only_leaves_out_the_weakest)
{
    struct look look;
    add_roadside(scene);
    struct echo_span all = see_as(scene, &automatic, &look);
    double weakest = 1, strongest = 0, faintest = 0.2 * 0.2 * pow(10, 9.0 / 20);
    scene->sensor.calibration_ercs *= pow(10, 9.0 / 20);
    suite_derive(&scene->sensor);
    struct echo_span strong = see_as(scene, &automatic, &look);
    assert_true(strong.count > 20 && strong.count < all.count);
    for (size_t i = 0; i < all.count; i++) {
        const struct echo *echo = find(strong, &all.items[i]);
        double amplitude = all.items[i].ercs * pow(60 / all.items[i].range_m, 2) *
                           antenna_gain(&scene->sensor.antenna, all.items[i].azimuth_rad);
        if (echo != NULL)
            assert_same(echo, &all.items[i]);
        if (echo != NULL)
            weakest = fmin(weakest, amplitude);
        else
            strongest = fmax(strongest, amplitude);
    }
    assert_near(weakest, faintest, 0.2);
    assert_near(strongest, faintest, 0.2);
}

/* MODEL 14.10: a perfect mirror raises the amplitude by 4/sqrt(6). Within a cell, what is strong
 * enough varies by a fifth. */
SCENE_TEST(what_a_road_may_raise_is_not_left_out)
{
    struct look look;
    add_roadside(scene);
    scene->sensor.mount_z_m = 0.5;
    scene->frame.conditions.road = ROAD_CONCRETE;
    struct echo_span all = see_as(scene, &automatic, &look);
    double enough = 0.2 * 0.2 * pow(10, 9.0 / 20) / (4 / sqrt(6.0));
    scene->sensor.calibration_ercs *= pow(10, 9.0 / 20);
    suite_derive(&scene->sensor);
    struct echo_span strong = see_as(scene, &automatic, &look);
    int kept = 0;
    for (size_t i = 0; i < all.count; i++) {
        const struct echo *echo = &all.items[i];
        double amplitude = echo->ercs * pow(60 / echo->range_m, 2) *
                           antenna_gain(&scene->sensor.antenna, echo->azimuth_rad);
        if (amplitude < 1.2 * enough)
            continue;
        assert_non_null(find(strong, echo));
        kept += amplitude < 1.5 * enough;
    }
    assert_true(kept > 5);
}

SCENE_TEST(auto_makes_the_echoes_of_all)
{
    uint64_t random = 5;
    add_roadside(scene);
    add_random_bodies(scene, &random);
    for (int i = 0; i < 60; i++) {
        struct look look;
        struct object *ego = frame_object(&scene->frame, "e");
        scene->sensor.field_of_view_rad = i % 2 == 0 ? 0.5 : 2 * PI;
        scene->sensor.mount_z_m = i % 3 == 0 ? 0.5 : 0;
        scene->sensor.range_max_m = sample_between(&random, 5, 150);
        ego->x_m = sample_between(&random, -250, 350);
        ego->y_m = sample_between(&random, -60, 60);
        ego->yaw_rad = sample_between(&random, -PI, PI);
        struct echo_span few = see_as(scene, &automatic, &look);
        struct echo_span all = see_as(scene, &everything, &look);
        assert_int_equal(few.count, all.count);
        for (size_t j = 0; j < few.count; j++)
            assert_same(&few.items[j], &all.items[j]);
    }
}

SCENE_TEST(without_strips_or_the_effect_there_are_no_echoes)
{
    struct look look;
    struct effect_log log = {0};
    struct selection none = {.allowed = EFFECT_BIT(EFFECT_OCCLUSION), .log = &log};
    assert_int_equal(see_as(scene, &everything, &look).count, 0);
    add_roadside(scene);
    assert_int_equal(see_as(scene, &none, &look).count, 0);
    assert_true(log.left_out == EFFECT_BIT(EFFECT_ROADSIDE));
    none.allowed |= EFFECT_BIT(EFFECT_ROADSIDE);
    assert_true(see_as(scene, &none, &look).count > 0);
    assert_true((log.simulated & EFFECT_BIT(EFFECT_ROADSIDE)) != 0);
}
