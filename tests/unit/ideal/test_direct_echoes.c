#include "ideal/direct_echoes.h"

#include "look_scene.h"
#include "text/record_write.h"

/* The one loss of a frame with no echo. */
static const struct lost_group *only_loss(const struct scene *scene)
{
    assert_int_equal(scene->frame.echoes.count, 0);
    assert_int_equal(scene->frame.lost.count, 1);
    assert_int_equal(scene->frame.lost.items[0].echoes.count, 1);
    return &scene->frame.lost.items[0];
}

SCENE_TEST(the_first_blocker_by_id_is_named)
{
    add_point(add_set(scene, "far"))->ercs = 1;
    add_set(scene, "y");
    add_set(scene, "x");
    add_set(scene, "w")->blocks = false;
    add_object(scene, "far", 40, 0);
    add_object(scene, "y", 10, 0);
    add_object(scene, "x", 20, 0);
    add_object(scene, "w", 30, 0);
    struct look look = look_at(scene, 10);
    const struct lost_group *lost = only_loss(scene);
    assert_int_equal(frame_loss_of(lost->reason), LOSS_BLOCKED);
    assert_string_equal(lost->stage, "ideal");
    assert_string_equal(lost->sensor, "front");
    assert_string_equal(lost->echoes.items[0].id.object, "far");
    assert_string_equal(lost->echoes.items[0].by, "x");
    assert_int_equal(look.pairs, 1);
    assert_int_equal(scene->frame.counts.items[0].pairs, 1);
    assert_int_equal(scene->frame.counts.items[0].paths.items[0].echoes, 0);
}

/* The pole of "p", which faces along x, is 30 m ahead and 40 m left of the sensor, which is on its
 * dark side; of the flat side from (20, -1) to (20, 1) the sensor sees the edge. */
SCENE_TEST(what_sends_no_echo_is_lost_where_it_is)
{
    struct reflector_set *set = add_set(scene, "p");
    add_point(set)->zero_rad = 1;
    *list_add(&set->planes, check_arena()) = (struct plane_reflector){
        .name = "rear", .from_x = 0.5, .from_y = 0.5, .to_x = 0.5, .to_y = -0.5, .ercs = 1};
    add_object(scene, "p", 30, 40);
    look_at(scene, 10);
    assert_int_equal(scene->frame.lost.count, 2);
    const struct lost_echo *pole = scene->frame.lost.items[0].echoes.items;
    const struct lost_echo *side = scene->frame.lost.items[1].echoes.items;
    assert_close(pole->range_m, 50, 0);
    assert_close(pole->azimuth_rad, 0.9273, 0); /* atan(4/3), to 1e-5 */
    assert_close(side->range_m, 51.225, 0);     /* hypot(32, 40), to 1 mm */
    assert_close(side->azimuth_rad, 0.89606, 0);
}

SCENE_TEST(an_object_does_not_block_itself_and_the_ego_blocks_nothing)
{
    struct reflector_set *set = add_set(scene, "a");
    add_point(set)->x = 0.5; /* the far end */
    add_object(scene, "a", 20, 0);
    scene->sensor.mount_x_m = -2; /* looks through its own car */
    look_at(scene, 10);
    assert_int_equal(scene->frame.echoes.count, 1);
    assert_close(scene->frame.echoes.items[0].range_m, 24, 1e-12);
}

SCENE_TEST(wheel_houses_are_seen_under_raised_vehicles_only)
{
    struct reflector_set *set = add_set(scene, "far");
    add_point(set)->name = "corner";
    struct point_reflector *wheel = add_point(set);
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

SCENE_TEST(every_loss_has_its_reason)
{
    static const struct {
        double x_m, y_m, facing_rad;
        enum loss reason;
    } cases[] = {{50, 0, 0, LOSS_FACING_AWAY},     {100.1, 0, PI, LOSS_OUT_OF_RANGE},
                 {0.05, 0, PI, LOSS_OUT_OF_RANGE}, {10, 10.001, -3 * PI / 4, LOSS_OUT_OF_VIEW},
                 {-10, 0, 0, LOSS_OUT_OF_VIEW},    {0, 0, 0, LOSS_OUT_OF_RANGE},
                 {500, 0, 0, LOSS_FACING_AWAY}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        clear_scene(scene);
        scene->sensor.field_of_view_rad = PI / 2;
        struct point_reflector *point = add_point(add_set(scene, "a"));
        point->facing_rad = cases[i].facing_rad;
        point->zero_rad = 1;
        add_object(scene, "a", cases[i].x_m, cases[i].y_m);
        look_at(scene, 10);
        assert_int_equal(frame_loss_of(only_loss(scene)->reason), cases[i].reason);
    }
}

SCENE_TEST(planes_mirror_from_the_foot_of_the_perpendicular)
{
    struct reflector_set *set = add_set(scene, "a");
    *list_add(&set->planes, check_arena()) = (struct plane_reflector){
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
    assert_int_equal(frame_loss_of(only_loss(scene)->reason), LOSS_NO_SPECULAR);
}

/* A lobe 60 degrees wide across and 40 upright, with its middle level, at most 20 dB deep. */
static double lobe_of(double off_degrees, double below_degrees)
{
    double across_db = 12 * (off_degrees / 60) * (off_degrees / 60);
    double upright_db = 12 * (below_degrees / 40) * (below_degrees / 40);
    return pow(10, -fmin(across_db + upright_db, 20) / 20);
}

SCENE_TEST(a_lobe_depends_on_direction_and_height_of_the_sensor)
{
    struct object *object = add_object(scene, "o", 10, 0);
    struct point_reflector *point = add_point(add_set(scene, "o"));
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

SCENE_TEST(posts_become_echoes_with_their_numbers)
{
    struct reflector_set *set = add_set(scene, "rail");
    set->blocks = false;
    add_posts(set, 4);
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
SCENE_TEST(a_margin_is_the_distance_from_another_answer)
{
    static const struct {
        double x_m, y_m, box_x_m;
        int reason; /* -1: seen */
        double margin_m;
    } cases[] = {
        {3, 0, 0, -1, 2},      /* nearest limit */
        {99.5, 0, 0, -1, 0.5}, /* farthest limit */
        {0.75, 0, 0, LOSS_OUT_OF_RANGE, 0.25},
        {102, 0, 0, LOSS_OUT_OF_RANGE, 2},
        {40, 39, 0, -1, 0},                 /* angle to the border of view: computed below */
        {39, 40, 0, LOSS_OUT_OF_VIEW, 0},   /* the same */
        {-10, 0, 0, LOSS_FACING_AWAY, 0},   /* angle to zero_rad: computed below */
        {60, 3, 30, -1, 0},                 /* distance from the box: computed below */
        {60, 0, 30, LOSS_BLOCKED, 1},       /* the box reaches 1 m to either side */
        {28.25, 0, 30, LOSS_BLOCKED, 0.25}, /* 0.25 m behind its rear at 28 m */
        {27.5, 0, 30, -1, 0.5},             /* 0.5 m before it */
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        clear_scene(scene);
        scene->frame.sections |= CARRY_MARGINS;
        scene->sensor.field_of_view_rad = PI / 2;
        scene->sensor.range_min_m = 1;
        struct point_reflector *pole = add_point(add_set(scene, "pole"));
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
            assert_int_equal(frame_loss_of(only_loss(scene)->reason), cases[i].reason);
        struct margins margins = only_margins(scene);
        assert_int_equal(margins.present, MARGIN_SIGHT);
        assert_close(margins.sight_m, margin_m, 1e-12);
    }
}

SCENE_TEST(an_echo_from_under_a_truck_can_change_in_two_ways)
{
    static const struct {
        double truck_y_m, wall_y_m, margin_m;
    } cases[] = {
        {0.5, 9, 0.5},   /* the line runs under the truck, 0.5 m from its side */
        {0, 1.25, 0.25}, /* the line passes the wall at 0.25 m */
        {-1.5, 3, 0.5},  /* the line passes the truck at 0.5 m */
        {0, 0.75, 0.25}, /* the wall blocks the line, 0.25 m deep */
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        clear_scene(scene);
        scene->frame.sections |= CARRY_MARGINS;
        add_point(add_set(scene, "pole"))->under_vehicles = 0.5;
        add_set(scene, "truck")->raised = true;
        add_set(scene, "wall");
        add_object(scene, "pole", 50, 0);
        add_object(scene, "truck", 20, cases[i].truck_y_m);
        add_object(scene, "wall", 30, cases[i].wall_y_m);
        look_at(scene, 10);
        assert_close(only_margins(scene).sight_m, cases[i].margin_m, 1e-12);
    }
}

/* A pole whose reflector is 0.4 m over the road, 50 m from a sensor at 0.5 m. A van that stands
 * between them from 0.2 m up leaves only the wave that the road mirrors. */
SCENE_TEST(an_elevation_is_that_of_the_way_the_wave_takes)
{
    scene->sensor.mount_z_m = 0.5;
    scene->sensor.elevation_view_rad = 0.3;
    add_point(add_set(scene, "pole"))->z = 0.2;
    struct reflector_set *van = add_set(scene, "van");
    add_object(scene, "pole", 50, 0)->height_m = 2;
    add_object(scene, "van", 27, 20)->height_m = 2;
    look_at(scene, 10);
    assert_near(scene->frame.echoes.items[0].elevation_rad, atan2(-0.1, 50), 1e-14);
    assert_int_equal(scene->frame.echoes.items[0].present, VALUE_ELEVATION);
    van->clearance_m = 0.2;
    scene->frame.objects.items[2].y_m = 0;
    scene->frame.echoes.count = 0;
    look_at(scene, 10);
    assert_int_equal(scene->frame.echoes.count, 1);
    assert_near(scene->frame.echoes.items[0].elevation_rad, atan2(-0.9, 50), 1e-14);
}

/* A reflector without a height is at that of the sensor. */
SCENE_TEST(a_reflector_without_a_height_has_the_elevation_0)
{
    scene->sensor.mount_z_m = 0.5;
    scene->sensor.elevation_view_rad = 0.3;
    add_point(add_set(scene, "pole"));
    add_object(scene, "pole", 50, 0);
    look_at(scene, 10);
    assert_close(scene->frame.echoes.items[0].elevation_rad, 0, 0);
    assert_int_equal(scene->frame.echoes.items[0].present, VALUE_ELEVATION);
}

SCENE_TEST(the_margin_of_a_plane_is_the_distance_of_its_foot_from_an_end)
{
    scene->frame.sections |= CARRY_MARGINS;
    struct reflector_set *set = add_set(scene, "a");
    *list_add(&set->planes, check_arena()) = (struct plane_reflector){
        .name = "rear", .from_x = -0.5, .from_y = 0.5, .to_x = -0.5, .to_y = -0.5, .ercs = 0.7};
    struct object *car = add_object(scene, "a", 20, 0.75);
    look_at(scene, 10);
    assert_close(only_margins(scene).sight_m, 0.25, 1e-12);
    scene->frame.echoes.count = 0;
    car->y_m = 1.5;
    look_at(scene, 10);
    assert_int_equal(frame_loss_of(only_loss(scene)->reason), LOSS_NO_SPECULAR);
    assert_close(only_margins(scene).sight_m, 0.5, 1e-12);
}

SCENE_TEST(without_margins_no_entry_has_any)
{
    add_point(add_set(scene, "a"));
    add_point(add_set(scene, "b"))->zero_rad = 1;
    add_object(scene, "a", 20, 0);
    add_object(scene, "b", 0, 20);
    look_at(scene, 10);
    assert_int_equal(scene->frame.echoes.items[0].margins.present, 0);
    assert_int_equal(scene->frame.lost.items[0].echoes.items[0].margins.present, 0);
}

/* Compares echoes as text, because the padding between members has no value. */
static void assert_same_echoes(const struct echo *one, const struct echo *other, size_t count)
{
    const struct record *record = field_find(&frame_record, "echoes", strlen("echoes"))->record;
    struct text texts[2] = {0};
    for (size_t i = 0; i < count; i++) {
        record_write(record, &one[i], NULL, &texts[0]);
        record_write(record, &other[i], NULL, &texts[1]);
    }
    assert_int_equal(texts[0].length, texts[1].length);
    if (count > 0)
        assert_memory_equal(texts[0].bytes, texts[1].bytes, texts[0].length);
    text_free(&texts[0]);
    text_free(&texts[1]);
}

SCENE_TEST(auto_without_an_account_finds_the_same_echoes)
{
    uint64_t random = 5;
    size_t echoes = 0, pairs = 0;
    for (int i = 0; i < 3000; i++) {
        clear_scene(scene);
        add_random_bodies(scene, &random);
        struct look all = look_at(scene, 10), some;
        struct frame *frame = &scene->frame, accounted = *frame;
        frame->sections &= ~(uint64_t)CARRY_ACCOUNT;
        memset(&frame->echoes, 0, sizeof frame->echoes);
        assert_int_equal(look_begin(&some, frame, &scene->sensor, &automatic, 10, NULL), 0);
        direct_echoes_add(&some);
        assert_int_equal(some.pairs, all.pairs);
        assert_int_equal(some.echoes, all.echoes);
        assert_same_echoes(frame->echoes.items, accounted.echoes.items, (size_t)some.echoes);
        echoes += (size_t)all.echoes;
        pairs += (size_t)all.pairs;
    }
    assert_true(echoes > 5000 && pairs > 100000);
}
