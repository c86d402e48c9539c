#include "ideal/look.h"

#include "look_scene.h"

SCENE_TEST(the_sensor_moves_with_the_lever_arm_of_a_turning_ego)
{
    struct object *ego = scene->frame.objects.items;
    ego->x_m = 100;
    ego->y_m = 50;
    ego->yaw_rad = PI / 2;
    ego->vy_mps = 10;
    ego->yaw_rate_radps = 0.5;
    scene->sensor.mount_x_m = 2;
    scene->sensor.mount_y_m = -1;
    scene->sensor.mount_yaw_rad = -PI / 2;
    add_point(add_set(scene, "a"));
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

SCENE_TEST(a_late_measurement_shows_where_everything_was)
{
    struct object *ego = scene->frame.objects.items;
    ego->vx_mps = 20;
    add_point(add_set(scene, "a"));
    add_point(add_set(scene, "b"))->x = 0.5;
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

SCENE_TEST(a_set_that_lists_an_unknown_object_is_refused)
{
    struct look look;
    struct diag diag = {0};
    add_set(scene, "ghost");
    assert_int_equal(look_begin(&look, &scene->frame, &scene->sensor, &everything, 10, &diag), -1);
    assert_string_equal(diag.text, "reflectors[0].objects[0]: \"ghost\" is not among the objects, "
                                   "or is the ego");
}

/* Eight at one place, of which five stay; a taller one, and one of another set, block otherwise. */
SCENE_TEST(bodies_that_block_alike_stand_for_each_other)
{
    static const char *const ids[] = {"a", "b", "c", "d", "f", "g", "h", "i", "tall", "other"};
    struct reflector_set *set = add_set(scene, "a");
    for (size_t i = 0; i < 10; i++)
        add_object(scene, ids[i], 30, 0);
    for (size_t i = 1; i < 9; i++)
        *list_add(&set->objects, check_arena()) = ids[i];
    scene->frame.objects.items[9].height_m = 9;
    add_set(scene, "other");
    struct look look = look_at(scene, 10);
    assert_int_equal(look.body_count, 10);
    assert_int_equal(look.indexed_count, 7);
    assert_string_equal(look.indexed[4]->object->id, "f");
    assert_string_equal(look.indexed[5]->object->id, "other");
    assert_string_equal(look.indexed[6]->object->id, "tall");
    scene->sensor.diffraction = true;
    scene->sensor.carrier_hz = 77e9;
    assert_int_equal(look_at(scene, 10).indexed_count, 10);
}

/* Places on and in the disc, as much above or below the sensor as is said. A steep sight line moves
 * a place outside the borders into view. */
SCENE_TEST(a_disc_out_of_view_has_no_place_in_view)
{
    uint64_t random = 9;
    int outside = 0, in_view = 0;
    for (int i = 0; i < 100000; i++) {
        scene->sensor.field_of_view_rad = sample_between(&random, 0.1, i % 2 ? 2 * PI : 1);
        scene->sensor.mount_z_m = i % 4 == 0 ? 0 : sample_between(&random, 0.2, 2);
        struct look look;
        assert_int_equal(look_begin(&look, &scene->frame, &scene->sensor, &everything, 10, NULL),
                         0);
        double distance_m = sample_between(&random, 0, i % 3 ? 60 : 5);
        struct vec2 sight = vec2_scale(distance_m, vec2_heading(sample_between(&random, -PI, PI)));
        struct vec2 centre = vec2_add(look.pose.position_m, sight), still = {0, 0};
        double radius_m = sample_between(&random, 0, 4), rise_m = sample_between(&random, 0, 3);
        bool out = look_disc_out_of_view(&look, rise_m, centre, radius_m);
        for (int k = 0; k < 6; k++) {
            double part_m = k < 4 ? radius_m : sample_between(&random, 0, radius_m), gain;
            double height_m = look.height_m + rise_m * (k % 2 ? 1 : -1);
            uint64_t effects = 0;
            struct vec2 arm = vec2_scale(part_m, vec2_heading(sample_between(&random, -PI, PI)));
            struct kinematics plane = look_kinematics(&look, vec2_add(centre, arm), still);
            struct kinematics read = look_slant(&look, height_m, plane, &gain, &effects);
            bool seen = look_within_view_rad(&look, read.azimuth_rad) > 0;
            assert_false(out && seen);
            in_view += seen;
        }
        outside += out;
    }
    assert_true(outside > 30000 && in_view > 100000);
}
