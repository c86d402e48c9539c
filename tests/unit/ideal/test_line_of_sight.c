#include "ideal/line_of_sight.h"

#include "geometry/obstruction.h"
#include "look_scene.h"

/* Two walls in line, one on the side of each of two objects, which meet before the sensor. */
static void add_two_walls(struct scene *scene)
{
    struct reflector_set *set = add_set(scene, "a");
    *list_add(&set->objects, check_arena()) = "b";
    *list_add(&set->planes, check_arena()) = (struct plane_reflector){
        .name = "right", .from_x = -0.5, .from_y = -0.5, .to_x = 0.5, .to_y = -0.5, .ercs = 1};
    add_object(scene, "a", 8, 21);
    add_object(scene, "b", 12, 21);
    scene->frame.objects.items[0].x_m = 10;
    scene->sensor.mount_yaw_rad = PI / 2;
}

SCENE_TEST(the_joint_of_two_walls_mirrors_once)
{
    static const double sensor_x_m[] = {10, 10 - 0x1p-49, 10 + 0x1p-49};
    static const char *const expected[] = {"b", "a", "b"};
    add_two_walls(scene);
    for (int i = 0; i < 3; i++) {
        scene->frame.objects.items[0].x_m = sensor_x_m[i];
        scene->frame.echoes.count = 0;
        look_at(scene, 10);
        assert_int_equal(scene->frame.echoes.count, 1);
        assert_string_equal(scene->frame.echoes.items[0].id.object, expected[i]);
        assert_close(scene->frame.echoes.items[0].range_m, 20, 0);
    }
}

/* The second wall begins a nanometre beyond the end of the first: neither hides a foot on the
 * other, but their ends are two vertices. */
SCENE_TEST(the_foot_on_a_wall_s_end_stays_if_the_next_wall_begins_a_hair_farther_on)
{
    add_two_walls(scene);
    scene->frame.objects.items[2].x_m = 12 + 1e-9;
    look_at(scene, 10);
    assert_int_equal(scene->frame.echoes.count, 1);
    assert_string_equal(scene->frame.echoes.items[0].id.object, "a");
}

/* A side that stands out of its body's box, in line with the side of a wall behind that body. */
SCENE_TEST(a_body_hides_nothing_of_a_wall_that_it_joins)
{
    struct reflector_set *wall = add_set(scene, "wall"), *front = add_set(scene, "front");
    *list_add(&wall->planes, check_arena()) = (struct plane_reflector){
        .name = "right", .from_x = -0.5, .from_y = -0.5, .to_x = 0.5, .to_y = -0.5, .ercs = 1};
    *list_add(&front->planes, check_arena()) = (struct plane_reflector){
        .name = "out", .from_x = 0.25, .from_y = 4 / 6.0, .to_x = 0.75, .to_y = 4 / 6.0, .ercs = 1};
    struct object *object = add_object(scene, "wall", 0, 10.5);
    object->length_m = 2;
    object->width_m = 1;
    add_object(scene, "front", 0, 6)->width_m = 6;
    scene->sensor.mount_yaw_rad = PI / 2;
    for (int joined = 1; joined >= 0; joined--) {
        scene->frame.echoes.count = 0;
        scene->frame.sections &= ~(uint64_t)CARRY_ACCOUNT;
        front->planes.count = (size_t)joined;
        struct look look;
        assert_int_equal(look_begin(&look, &scene->frame, &scene->sensor, &automatic, 10, NULL), 0);
        direct_echoes_add(&look);
        assert_int_equal(look.echoes, joined);
    }
}

/* Circles around and within bodies decide most lines; the exact test must agree on all. */
SCENE_TEST(a_line_is_blocked_where_it_touches_an_outline)
{
    uint64_t random = 11;
    size_t blocked = 0, lines = 0;
    for (int i = 0; i < 2000; i++) {
        clear_scene(scene);
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
                    obstruction_blocks(look.bodies[j].corner, 4, line.from, line.to))
                    by = &look.bodies[j];
            struct line_of_sight found = line_of_sight_along(&look, &line, NULL, 0);
            assert_ptr_equal(found.by, by);
            assert_true(found.factor == (by == NULL));
            blocked += by != NULL;
            lines++;
        }
    }
    assert_true(blocked > lines / 10 && blocked < lines / 2);
}

/* A plane from corner to corner of a car of 4 m by 2 m at (10, 20) that heads along (0.6, 0.8). */
SCENE_TEST(a_side_has_the_place_and_direction_of_its_plane)
{
    add_set(scene, "a");
    add_object(scene, "a", 10, 20)->yaw_rad = atan2(0.8, 0.6);
    struct look look = look_at(scene, 10);
    static const struct plane_reflector across = {
        .from_x = -0.5, .from_y = -0.5, .to_x = 0.5, .to_y = 0.5};
    struct side side =
        line_of_sight_side(&look.bodies[0], across.from_x, across.from_y, across.to_x, across.to_y);
    assert_close(side.from.x, 9.6, 1e-14);
    assert_close(side.from.y, 17.8, 1e-14);
    assert_close(side.to.x, 10.4, 1e-14);
    assert_close(side.to.y, 22.2, 1e-14);
    assert_close(side.along.x, 0.8 / sqrt(20), 1e-15);
    assert_close(side.along.y, 4.4 / sqrt(20), 1e-15);
}

static const struct obstruction_line ahead = {.from = {0, 0}, .to = {60, 0}};

/* Adds a body of 4 m by 2 m whose right side is left_m to the left of the line ahead. */
static void add_body(struct scene *scene, const char *id, double x_m, double left_m)
{
    add_set(scene, id);
    add_object(scene, id, x_m, left_m + 1);
}

/* By ITU-R P.526, J(0) is 6.03 dB each way. */
SCENE_TEST(a_touched_edge_takes_six_decibels_each_way)
{
    scene->sensor.diffraction = true;
    scene->sensor.carrier_hz = 24e9;
    add_body(scene, "a", 20, 0);
    struct look look = look_at(scene, 10);
    struct line_of_sight seen = line_of_sight_along(&look, &ahead, NULL, 0);
    assert_close(20 * log10(seen.factor), -2 * 6.03, 0.01);
    assert_null(seen.by);
    assert_true(seen.effects == EFFECT_BIT(EFFECT_DIFFRACTION));
}

SCENE_TEST(factors_of_two_bodies_multiply)
{
    scene->sensor.diffraction = true;
    scene->sensor.carrier_hz = 24e9;
    add_body(scene, "a", 20, 0.02);
    add_body(scene, "b", 45, -1.98);
    struct look look = look_at(scene, 10);
    const struct look_body *a = &look.bodies[0], *b = &look.bodies[1];
    double past_a = line_of_sight_along(&look, &ahead, &b, 1).factor;
    double past_b = line_of_sight_along(&look, &ahead, &a, 1).factor;
    assert_true(past_a > 0 && past_a < 1 && past_b > 0 && past_b < 1 && past_a != past_b);
    assert_near(line_of_sight_along(&look, &ahead, NULL, 0).factor, past_a * past_b, 1e-15);
    const struct look_body *both[] = {a, b};
    assert_close(line_of_sight_along(&look, &ahead, both, 2).factor, 1, 0);
}

SCENE_TEST(raised_bodies_do_not_block_a_line_under_them)
{
    add_body(scene, "a", 20, -1);
    add_body(scene, "b", 30, 5);
    scene->frame.reflectors.items[0].raised = true;
    struct look look = look_at(scene, 10);
    line_of_sight_find_blockers(&look, NULL, &look.bodies[0].shadow);
    assert_int_equal(look.blocker_count, 2);
    assert_ptr_equal(line_of_sight_past_blockers(&look, NULL, &ahead, false).by, &look.bodies[0]);
    assert_null(line_of_sight_past_blockers(&look, NULL, &ahead, true).by);
    assert_close(line_of_sight_margin_m(&look, NULL, 0, &ahead, false, true), 1, 1e-14);
    assert_close(line_of_sight_margin_m(&look, NULL, 0, &ahead, true, true), 0, 0);
    assert_close(line_of_sight_margin_m(&look, NULL, 0, &ahead, true, false), 5, 1e-14);
}

SCENE_TEST(the_margin_of_a_clear_line_is_its_distance_from_the_nearest_body)
{
    struct look look = look_at(scene, 10);
    assert_true(line_of_sight_margin_m(&look, NULL, 0, &ahead, false, false) == (double)INFINITY);
    add_body(scene, "a", 20, 3);
    add_body(scene, "b", 30, -4.5);
    add_set(scene, "c")->blocks = false;
    add_object(scene, "c", 40, 0);
    look = look_at(scene, 10);
    const struct look_body *b = &look.bodies[1];
    assert_close(line_of_sight_margin_m(&look, NULL, 0, &ahead, false, false), 2.5, 1e-14);
    assert_close(line_of_sight_margin_m(&look, &b, 1, &ahead, false, false), 3, 1e-14);
    static const struct selection without = {.allowed = EFFECT_BIT(EFFECT_SUPERPOSITION)};
    look.selection = &without;
    assert_true(line_of_sight_margin_m(&look, NULL, 0, &ahead, false, false) == (double)INFINITY);
}

/* The line crosses two bodies, 0.75 m and 0.25 m inside their nearest sides. */
SCENE_TEST(the_margin_of_a_blocked_line_is_its_greatest_depth_in_a_body)
{
    add_body(scene, "a", 20, -1.25);
    add_body(scene, "b", 40, -0.25);
    struct look look = look_at(scene, 10);
    const struct look_body *a = &look.bodies[0];
    assert_close(line_of_sight_margin_m(&look, NULL, 0, &ahead, false, true), 0.75, 1e-14);
    assert_close(line_of_sight_margin_m(&look, &a, 1, &ahead, false, true), 0.25, 1e-14);
}

/* A line that rises from 1 m to 3 m over the road: over a body from 18 m to 22 m it is at least 1.6
 * m high. */
SCENE_TEST(the_margin_of_a_line_over_a_body_is_its_height_above_the_top)
{
    static const struct obstruction_line rising = {{0, 0}, {60, 0}, 1, 3};
    scene->sensor.mount_z_m = 1;
    add_body(scene, "a", 20, -1);
    scene->frame.objects.items[1].height_m = 1.25;
    struct look look = look_at(scene, 10);
    struct line_of_sight seen = line_of_sight_along(&look, &rising, NULL, 0);
    assert_close(seen.factor, 1, 0);
    assert_true(seen.effects == EFFECT_BIT(EFFECT_HEIGHT));
    assert_close(line_of_sight_margin_m(&look, NULL, 0, &rising, false, false), 1.6 - 1.25, 1e-14);
    scene->frame.objects.items[1].height_m = 1.7;
    look = look_at(scene, 10);
    assert_ptr_equal(line_of_sight_along(&look, &rising, NULL, 0).by, &look.bodies[0]);
    assert_close(line_of_sight_margin_m(&look, NULL, 0, &rising, false, true), 1.7 - 1.6, 1e-14);
}

/* Random bodies under auto: what circles and silhouettes answer is not tested exactly. */
static struct look look_at_random_bodies(struct scene *scene, uint64_t *random)
{
    struct look look;
    add_random_bodies(scene, random);
    scene->frame.sections &= ~(uint64_t)CARRY_ACCOUNT;
    assert_int_equal(look_begin(&look, &scene->frame, &scene->sensor, &automatic, 10, NULL), 0);
    direct_echoes_add(&look);
    return look;
}

static struct obstruction_line line_to_pole(const struct look *look, const struct look_body *body)
{
    const struct point_reflector *pole = body->set->reflectors->points.items;
    return (struct obstruction_line){look->pose.position_m,
                                     reflectors_point_place(&body->box, pole), look->height_m,
                                     look_reflector_height_m(look, body, pole->z)};
}

/* What the bodies let pass, each by the exact test. */
static struct line_of_sight past_each(const struct look *look, const struct look_body *own,
                                      const struct obstruction_line *line)
{
    struct line_of_sight all = {.factor = 1};
    for (size_t i = 0; i < look->indexed_count; i++) {
        const struct look_body *body = look->indexed[i];
        if (body == own)
            continue;
        struct obstruction one =
            obstruction_of(body->corner, 4, look_heights(look, body), line, look->wavelength_m);
        if (one.factor == 0)
            return (struct line_of_sight){.factor = 0, .by = body};
        all.factor *= one.factor;
        all.effects |= one.bent ? EFFECT_BIT(EFFECT_DIFFRACTION) : 0;
        all.effects |= one.over ? EFFECT_BIT(EFFECT_HEIGHT) : 0;
    }
    return all;
}

SCENE_TEST(the_blockers_of_a_body_let_the_same_pass_as_all_bodies)
{
    uint64_t random = 12;
    size_t blocked = 0, bent = 0, lines = 0;
    for (int i = 0; i < 1000; i++) {
        clear_scene(scene);
        struct look look = look_at_random_bodies(scene, &random);
        for (size_t j = 0; j < look.body_count; j++) {
            const struct look_body *body = &look.bodies[j];
            struct look_extent extent = look_reflectors_extent(&look, body, body->set);
            const struct obstruction_line line = line_to_pole(&look, body);
            line_of_sight_find_blockers(&look, body, &extent);
            struct line_of_sight some = line_of_sight_past_blockers(&look, NULL, &line, false);
            struct line_of_sight all = line_of_sight_along(&look, &line, &body, 1);
            struct line_of_sight each = past_each(&look, body, &line);
            assert_ptr_equal(some.by, all.by);
            assert_ptr_equal(all.by, each.by);
            assert_true(some.factor == all.factor && all.factor == each.factor);
            assert_true(each.by != NULL ||
                        (some.effects == all.effects && all.effects == each.effects));
            blocked += all.by != NULL;
            bent += all.factor > 0 && all.factor < 1;
            lines++;
        }
    }
    assert_true(blocked > lines / 20 && blocked < lines / 2 && bent > 100);
}

SCENE_TEST(where_a_set_is_all_hidden_each_of_its_points_is_blocked)
{
    uint64_t random = 13;
    size_t hidden = 0;
    for (int i = 0; i < 1000; i++) {
        clear_scene(scene);
        struct look look = look_at_random_bodies(scene, &random);
        for (size_t j = 0; j < look.body_count; j++) {
            const struct look_body *body = &look.bodies[j];
            struct look_extent extent = look_reflectors_extent(&look, body, body->set);
            const struct obstruction_line line = line_to_pole(&look, body);
            bool under = body->set->reflectors->points.items[0].under_vehicles > 0;
            line_of_sight_find_blockers(&look, body, &extent);
            if (!line_of_sight_all_hidden(&look, body->set, &extent))
                continue;
            assert_non_null(line_of_sight_past_blockers(&look, NULL, &line, under).by);
            hidden++;
        }
    }
    assert_true(hidden > 200);
}
