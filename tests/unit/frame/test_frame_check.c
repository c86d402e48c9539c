#include "frame/frame_check.h"

#include "accounted_frame.h"
#include "check.h"
#include "frame/frame_order.h"

TEST(a_frame_without_contradictions_passes)
{
    struct frame frame = accounted_frame(check_arena());
    frame_order(&frame);
    assert_done(frame_check, &frame, ~0U);
    assert_done(frame_check_parts, &frame, (struct frame_parts){.parts = ~0U});
}

static void name_one_twice(struct frame *frame)
{
    frame->objects.items[1].id = "a";
}

static void lose_the_ego(struct frame *frame)
{
    frame->ego = "x";
}

static void name_a_sensor_twice(struct frame *frame)
{
    frame->sensors.list.items[0].name = "left";
}

static void see_one_twice(struct frame *frame)
{
    for (int i = 0; i < 2; i++)
        *list_add(&frame->echoes, frame->arena) =
            (struct echo){.sensor = "left", .id.object = "a", .id.reflector = "r"};
}

static void see_with_no_sensor(struct frame *frame)
{
    *list_add(&frame->echoes, frame->arena) =
        (struct echo){.sensor = "top", .id.object = "a", .id.reflector = "r"};
}

static void open_a_cell_twice(struct frame *frame)
{
    for (int i = 0; i < 2; i++)
        *list_add(&frame->cells, frame->arena) = accounted_cell(
            frame->arena, "left", 1, (struct contributor[]){accounted_echo("a", "r")});
}

static void open_an_empty_cell(struct frame *frame)
{
    *list_add(&frame->cells, frame->arena) = (struct cell){.sensor = "left"};
}

static void report_a_target_without_label(struct frame *frame)
{
    frame->targets.items[1].contributors.count = 0;
}

static void report_with_no_sensor(struct frame *frame)
{
    frame->targets.items[1].sensor = "top";
}

static struct reflector_set *add_set(struct frame *frame)
{
    struct reflector_set *set = list_add(&frame->reflectors, frame->arena);
    *set = (struct reflector_set){.model = "car"};
    frame->present |= PART_REFLECTORS;
    return set;
}

static void list_an_object_twice(struct frame *frame)
{
    struct reflector_set *set = add_set(frame);
    for (int i = 0; i < 2; i++)
        *list_add(&set->objects, frame->arena) = "a";
}

static void name_two_reflectors_alike(struct frame *frame)
{
    struct reflector_set *set = add_set(frame);
    *list_add(&set->points, frame->arena) = (struct point_reflector){.name = "rear"};
    *list_add(&set->planes, frame->arena) = (struct plane_reflector){.name = "rear"};
}

static void give_a_mirror_two_laws(struct frame *frame)
{
    struct reflector_set *set = add_set(frame);
    *list_add(&set->mirrors, frame->arena) = (struct mirror_plane){.material = MATERIAL_METAL};
    *list_add(&set->mirrors, frame->arena) =
        (struct mirror_plane){.material = MATERIAL_METAL, .reflection = 0.5};
}

static void give_a_mirror_no_law(struct frame *frame)
{
    struct reflector_set *set = add_set(frame);
    *list_add(&set->mirrors, frame->arena) = (struct mirror_plane){.radius_m = 1};
}

TEST(frames_that_contradict_themselves_are_refused)
{
    static const struct {
        void (*plant)(struct frame *frame);
        const char *message;
    } cases[] = {
        {name_one_twice, "objects: the id \"a\" stands twice"},
        {lose_the_ego, "ego: \"x\" is not among the objects"},
        {list_an_object_twice, "reflectors[0]: \"a\" stands twice"},
        {name_two_reflectors_alike, "reflectors[0]: \"rear\" stands twice"},
        {give_a_mirror_two_laws,
         "reflectors[0].mirrors[1]: expected either a material or a reflection"},
        {give_a_mirror_no_law,
         "reflectors[0].mirrors[0]: expected either a material or a reflection"},
        {name_a_sensor_twice, "sensors.list: \"left\" stands twice"},
        {see_one_twice, "echoes: sensor \"left\", object \"a\", reflector \"r\" stands twice"},
        {see_with_no_sensor, "echoes[0].sensor: \"top\" is not in sensors.list"},
        {open_a_cell_twice, "cells: sensor \"left\" has two led by object \"a\", reflector \"r\""},
        {open_an_empty_cell, "cells[0].members: empty; expected the leader"},
        {report_a_target_without_label, "targets[0].contributors: empty; expected a label"},
        {report_with_no_sensor, "targets[1].sensor: \"top\" is not in sensors.list"}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct frame frame = accounted_frame(check_arena());
        cases[i].plant(&frame);
        frame_order(&frame);
        assert_refused(DIAG_DATA, cases[i].message, frame_check, &frame, ~0U);
    }
}

static void sight_with_no_sensor(struct frame *frame)
{
    *list_add(&frame->visibility, frame->arena) = (struct sighting){.sensor = "top", .object = "a"};
}

/* What a frame says of one part, in canonical order, after a fault was planted anywhere. */
static int check_parts(void (*plant)(struct frame *frame), unsigned parts, const char *stage,
                       struct diag *diag)
{
    struct frame frame = accounted_frame(check_arena());
    plant(&frame);
    frame_order(&frame);
    int result =
        frame_check_parts(&frame, (struct frame_parts){.parts = parts, .stage = stage}, diag);
    return result;
}

TEST(a_part_is_refused_for_its_own_faults_alone)
{
    static const struct {
        void (*plant)(struct frame *frame);
        unsigned part, another;
    } cases[] = {{name_one_twice, PART_OBJECTS, PART_ECHOES},
                 {list_an_object_twice, PART_REFLECTORS, PART_OBJECTS},
                 {name_a_sensor_twice, PART_SENSORS, PART_OBJECTS},
                 {open_an_empty_cell, PART_CELLS, PART_TARGETS},
                 {report_a_target_without_label, PART_TARGETS, PART_CELLS},
                 {sight_with_no_sensor, PART_VISIBILITY, PART_TARGETS}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct diag diag = {0};
        assert_int_equal(check_parts(cases[i].plant, cases[i].part, NULL, &diag), -1);
        assert_int_equal(diag.code, DIAG_DATA);
        assert_int_equal(check_parts(cases[i].plant, cases[i].another, NULL, &diag), 0);
    }
}

/* Echoes, cells and targets name their sensors: who lists others may leave them without one. */
TEST(new_sensors_are_held_against_all_that_names_one)
{
    struct diag target = {0}, echo = {0}, sighting = {0};
    assert_int_equal(check_parts(report_with_no_sensor, PART_SENSORS, NULL, &target), -1);
    assert_string_equal(target.text, "targets[1].sensor: \"top\" is not in sensors.list");
    assert_int_equal(check_parts(see_with_no_sensor, PART_SENSORS, NULL, &echo), -1);
    assert_string_equal(echo.text, "echoes[0].sensor: \"top\" is not in sensors.list");
    assert_int_equal(check_parts(sight_with_no_sensor, PART_SENSORS, NULL, &sighting), -1);
    assert_string_equal(sighting.text, "visibility[0].sensor: \"top\" is not in sensors.list");
}

static void report_beyond_bounds(struct frame *frame)
{
    frame->targets.items[1].amplitude_db = 1e5;
}

TEST(members_out_of_bounds_are_refused_by_their_path)
{
    struct diag diag = {0};
    assert_int_equal(check_parts(report_beyond_bounds, PART_TARGETS, NULL, &diag), -1);
    assert_string_equal(diag.text, "targets[0].amplitude_db: 1e+05 is outside [-10000, 10000] dB");
    assert_int_equal(check_parts(report_beyond_bounds, PART_LOST, NULL, &diag), 0);
}

/* Items of a list may change in place, without a change of the header's own bytes. */
TEST(a_header_is_checked_if_it_is_asked_for_or_has_lists)
{
    struct frame frame = accounted_frame(check_arena());
    struct frame_parts none = {0}, header = {.parts = PART_HEADER};
    frame.time_s = (double)NAN;
    assert_done(frame_check_parts, &frame, none);
    assert_refused(DIAG_DATA, "time_s: nan is outside [-1e10, 1e10] s", frame_check_parts, &frame,
                   header);
    frame.time_s = 0;
    struct roadside_strip *strip = list_add(&frame.roadside, frame.arena);
    assert_done(frame_check_parts, &frame, none);
    strip->width_m = -1;
    assert_refused(DIAG_DATA, "roadside[0].width_m: -1 is outside [0, 100] m", frame_check_parts,
                   &frame, none);
}

static void lose_by_too_much(struct frame *frame)
{
    frame_lose(frame, "noise", "left", LOSS_BELOW_FINAL,
               &(struct lost_echo){.id.object = "b", .id.reflector = "p", .shortfall_db = -1});
}

/* A stage is to blame for what it lost itself. */
TEST(losses_are_looked_at_where_their_own_stage_wrote_them)
{
    struct diag diag = {0};
    assert_int_equal(check_parts(lose_by_too_much, PART_LOST, "ideal", &diag), 0);
    assert_int_equal(check_parts(lose_by_too_much, PART_LOST, "noise", &diag), -1);
    assert_string_equal(diag.text, "lost[1].echoes[0].shortfall_db: -1 is outside [0, 100000] dB");
    assert_int_equal(check_parts(lose_by_too_much, PART_LOST, NULL, &diag), -1);
}

/* A document was checked when it was read: no set that has its lists is searched again. */
TEST(the_lists_of_a_document_are_not_searched_again)
{
    struct frame frame = accounted_frame(check_arena());
    struct diag diag = {0};
    name_two_reflectors_alike(&frame);
    struct reflector_set document = frame.reflectors.items[0];
    frame.reflectors.items[0].document = &document;
    frame_order(&frame);
    assert_int_equal(frame_check(&frame, ~0U, &diag), 0);
    list_add(&frame.reflectors.items[0].points, check_arena())->name = "left";
    assert_int_equal(frame_check(&frame, ~0U, &diag), -1);
}
