#include "check.h"

#include "view/view_frame.h"

/* The ego drives ahead at 10 m/s; its sensor is mounted 2 m ahead. */
struct scene {
    struct object ego;
    struct sensor_view sensor;
    struct frame frame;
};

static const struct frame *frame_of(struct scene *scene)
{
    scene->ego = (struct object){.id = "ego", .class = "car", .x_m = 100, .vx_mps = 10};
    scene->sensor = (struct sensor_view){.name = "front", .mount_x_m = 2, .measured = true};
    scene->frame = (struct frame){.ego = "ego", .time_s = 4, .interval_s = 0.1};
    scene->frame.objects.items = &scene->ego;
    scene->frame.objects.count = 1;
    return &scene->frame;
}

TEST(a_sensor_stands_where_it_was_when_it_measured)
{
    struct scene scene;
    const struct frame *frame = frame_of(&scene);
    scene.sensor.age_s = 0.1;
    struct view_scan scan = view_frame_scan(frame, &scene.sensor);
    assert_close(scan.age_s, 0.1, 0);
    assert_close(scan.pose.position_m.x, 101, 1e-12);
    assert_close(view_frame_place(&scan, 5, 0).x, 106, 1e-12);
    assert_close(view_frame_place(&scan, 5, acos(-1) / 2).y, 5, 1e-12);
}

TEST(a_sensor_that_has_not_measured_stands_where_the_ego_is_now)
{
    struct scene scene;
    const struct frame *frame = frame_of(&scene);
    scene.sensor.measured = false;
    struct view_scan scan = view_frame_scan(frame, &scene.sensor);
    assert_close(scan.age_s, 0, 0);
    assert_close(scan.pose.position_m.x, 102, 1e-12);
}

TEST(without_objects_the_ego_is_at_the_origin_and_its_velocity_unknown)
{
    struct frame frame = {.ego = "ego", .time_s = 4};
    const struct sensor_view sensor = {.name = "front", .mount_x_m = 2, .age_s = 0.1};
    struct view_scan scan = view_frame_scan(&frame, &sensor);
    assert_close(scan.pose.position_m.x, 2, 0);
    assert_close(view_frame_place(&scan, 5, 0).x, 7, 0);
    assert_true(isnan(scan.pose.velocity_mps.x));
}

TEST(a_box_without_a_size_has_that_of_its_class)
{
    const struct vehicle car = {.length_m = 4.5, .width_m = 1.8};
    struct object object = {.length_m = 3};
    struct box box = view_frame_box(&object, &car);
    assert_close(box.length_m, 3, 0);
    assert_close(box.width_m, 1.8, 0);
    assert_close(view_frame_box(&object, NULL).width_m, 0, 0);
}
