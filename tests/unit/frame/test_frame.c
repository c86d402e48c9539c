#include "frame/frame.h"

#include "accounted_frame.h"
#include "check.h"
#include "frame/frame_order.h"

TEST(losses_are_grouped_by_sensor_stage_and_reason)
{
    struct frame frame = {.arena = check_arena(), .sections = CARRY_ACCOUNT};
    static const char *const sensors[] = {"s", "t"}, *const stages[] = {"ideal", "noise"};
    for (int i = 0; i < 24; i++)
        frame_lose(&frame, stages[i % 2], sensors[i / 12], i / 2 % 2 ? LOSS_BLOCKED : LOSS_NO_ANGLE,
                   &(struct lost_echo){.id.object = "o", .id.reflector = "r"});
    assert_int_equal(frame.lost.count, 8);
    for (size_t i = 0; i < 8; i++)
        assert_int_equal(frame.lost.items[i].echoes.count, 3);
    assert_int_equal(frame.present, PART_LOST);
    frame_order(&frame);
    frame_lose(&frame, "noise", "s", LOSS_BLOCKED,
               &(struct lost_echo){.id.object = "p", .id.reflector = "r"});
    assert_int_equal(frame.lost.count, 8);
    struct cell cell =
        accounted_cell(check_arena(), "s", 2,
                       (struct contributor[]){accounted_echo("o", "p"), accounted_echo("o", "q")});
    frame_lose_cell(&frame, "sensor", &cell, LOSS_BELOW_THRESHOLD, 4.5, &cell.margins);
    const struct lost_group *group = &frame.lost.items[8];
    assert_int_equal(group->echoes.count, 2);
    assert_string_equal(group->echoes.items[1].id.reflector, "q");
    assert_close(group->echoes.items[1].shortfall_db, 4.5, 0);
}

TEST(a_stage_may_have_reasons_of_its_own)
{
    struct frame frame = {.arena = check_arena(), .sections = CARRY_ACCOUNT};
    const struct lost_echo echo = {.id.object = "o", .id.reflector = "r"};
    char word[] = "covered", known[] = "blocked"; /* as a line that was read has them */
    frame_lose_own(&frame, "mud", "s", "covered", &echo);
    frame_lose_own(&frame, "mud", "s", word, &echo);
    frame_lose_own(&frame, "mud", "s", "blurred", &echo);
    frame_lose(&frame, "mud", "s", LOSS_MASKED, &echo);
    frame_lose(&frame, "mud", "s", LOSS_BLOCKED, &echo);
    frame_lose_own(&frame, "mud", "s", known, &echo);
    frame_order_parts(&frame, (struct frame_parts){.parts = PART_LOST});
    static const struct {
        const char *words;
        size_t echoes;
        enum loss loss;
    } groups[] = {{"blocked", 2, LOSS_BLOCKED},
                  {"masked", 1, LOSS_MASKED},
                  {"mud: blurred", 1, LOSS_OWN},
                  {"mud: covered", 2, LOSS_OWN}};
    assert_int_equal(frame.lost.count, COUNT(groups));
    for (size_t i = 0; i < COUNT(groups); i++) {
        const struct lost_group *group = &frame.lost.items[i];
        assert_string_equal(frame_loss_words(group, check_arena()), groups[i].words);
        assert_int_equal(frame_loss_of(group->reason), groups[i].loss);
        assert_int_equal(group->echoes.count, groups[i].echoes);
        assert_int_equal(group->effect == EFFECT_NONE, groups[i].loss == LOSS_OWN);
    }
}

TEST(a_frame_without_account_forgets_its_losses)
{
    struct frame frame = {.arena = check_arena()};
    frame_lose(&frame, "ideal", "s", LOSS_BLOCKED,
               &(struct lost_echo){.id.object = "o", .id.reflector = "r"});
    assert_int_equal(frame.lost.count, 0);
    assert_int_equal(frame.present, 0);
}

TEST(spans_are_the_sensors_own)
{
    static const char *const sensors[] = {"a", "b", "d"};
    struct arena *arena = check_arena();
    struct frame frame = {.arena = arena};
    for (size_t i = 0; i < 9; i++) {
        *list_add(&frame.echoes, arena) = (struct echo){.sensor = sensors[i / 3]};
        *list_add(&frame.cells, arena) = (struct cell){.sensor = sensors[i / 3]};
    }
    for (size_t i = 0; i < 3; i++) {
        assert_ptr_equal(frame_echoes_of(&frame, sensors[i]).items, frame.echoes.items + 3 * i);
        assert_int_equal(frame_echoes_of(&frame, sensors[i]).count, 3);
        assert_ptr_equal(frame_cells_of(&frame, sensors[i]).items, frame.cells.items + 3 * i);
        assert_int_equal(frame_cells_of(&frame, sensors[i]).count, 3);
    }
    assert_int_equal(frame_echoes_of(&frame, "c").count, 0);
    assert_int_equal(frame_cells_of(&frame, "").count, 0);
}

TEST(a_class_has_its_own_documents)
{
    static const char *const classes[] = {"bus", "car", "car_2", "van"};
    struct arena *arena = check_arena();
    struct frame frame = {.arena = arena};
    for (size_t i = 0; i < COUNT(classes); i++)
        list_add(&frame.vehicles, arena)->class = classes[i];
    for (size_t i = 0; i < COUNT(classes); i++) {
        struct document_span own = frame_documents_of(&frame, classes[i]);
        assert_ptr_equal(own.items, frame.vehicles.items + i);
        assert_int_equal(own.count, 1);
    }
    assert_int_equal(frame_documents_of(&frame, "truck").count, 0);
}

TEST(dropped_parts_are_as_if_they_had_never_been)
{
    struct frame frame = accounted_frame(check_arena());
    frame_drop(&frame, PART_SENSORS | PART_TARGETS | PART_LOST);
    assert_int_equal(frame.present, PART_OBJECTS | PART_COUNTS);
    assert_int_equal(frame.targets.count + frame.lost.count + frame.sensors.list.count, 0);
    assert_null(frame.sensors.suite);
    assert_int_equal(frame.objects.count, 3);
    assert_int_equal(frame.counts.count, 2);
    assert_string_equal(frame_part_name(PART_TARGETS), "targets");
}

/* The azimuth of an elevated target is the angle of a cone: 12, 5 and 0.4 ahead, left and up are
 * sqrt(169.16) away. */
TEST(a_measured_elevation_shortens_the_way_ahead)
{
    double range_m = sqrt(169.16);
    struct target target = {
        .range_m = range_m, .azimuth_rad = asin(5 / range_m), .elevation_rad = asin(0.4 / range_m)};
    assert_near(frame_target_place(&target).x, sqrt(169.16 - 25), 1e-14);
    target.present = VALUE_ELEVATION;
    assert_close(frame_target_place(&target).x, 12, 1e-13);
    assert_close(frame_target_place(&target).y, 5, 1e-13);
    target.azimuth_rad = acos(-1) - target.azimuth_rad;
    assert_close(frame_target_place(&target).x, -12, 1e-13);
    target.elevation_rad = acos(0);
    assert_close(frame_target_place(&target).x, 0, 0);
}

/* An object may have the name that clutter has in its place. */
TEST(clutter_and_noise_are_of_no_object)
{
    struct object car = {.id = "roadside"};
    struct contributor part = {.id = {.object = "roadside"}};
    struct target target = {.contributors = {&part, 1, 1}};
    struct frame frame = {.objects = {&car, 1, 1}, .targets = {&target, 1, 1}};
    for (enum path path = PATH_DIRECT; path < PATH_COUNT; path++) {
        bool none = path == PATH_CLUTTER || path == PATH_FALSE_ALARM;
        part.id.path = path;
        assert_ptr_equal(frame_object_of(&frame, &part.id), none ? NULL : &car);
        assert_int_equal(frame_detects(&frame, "roadside"), !none);
    }
    struct echo_id clutter = {.object = "roadside", .path = PATH_CLUTTER};
    assert_null(frame_object_of(&frame, &(struct echo_id){.object = "van"}));
    assert_true(frame_same_object(&clutter, &clutter));
    assert_false(frame_same_object(&clutter, &(struct echo_id){.object = "roadside"}));
    assert_true(frame_same_object(&(struct echo_id){.object = "roadside", .path = PATH_WHEEL},
                                  &(struct echo_id){.object = "roadside"}));
}
