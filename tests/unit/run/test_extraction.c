#include "run_bench.h"

#include "run/extraction.h"

/* Two cars, a truck and the ego, another car. */
static void make_frame(struct frame *frame, struct arena *arena)
{
    static const char *const objects[][2] = {
        {"z", "car"}, {"ego", "car"}, {"b", "truck"}, {"a", "car"}};
    *frame = (struct frame){.ego = "ego", .present = PART_OBJECTS, .arena = arena};
    for (size_t i = 0; i < 4; i++)
        *list_add(&frame->objects, arena) =
            (struct object){.id = objects[i][0], .class = objects[i][1]};
}

/* One step on the frame: its result. */
static int step(struct frame *frame, struct runner *runner, extraction_describe *describe)
{
    return extraction_step(runner->state, frame, runner, describe);
}

TEST(sizes_of_zero_are_those_of_the_class)
{
    struct frame frame;
    struct runner runner;
    begin_stage(&runner, "extract", NO_WORDS);
    make_frame(&frame, check_arena());
    frame.objects.items[0].width_m = 2.5;
    assert_int_equal(step(&frame, &runner, NULL), 0);
    const struct vehicle *car = runner_vehicle(&runner, NULL, "car");
    assert_close(frame.objects.items[0].length_m, car->length_m, 0);
    assert_close(frame.objects.items[0].width_m, 2.5, 0);
    assert_close(frame.objects.items[0].height_m, car->height_m, 0);
    assert_close(frame.objects.items[1].width_m, car->width_m, 0); /* the ego's, too */
    assert_true(frame.objects.items[2].length_m > car->length_m);
    runner_free(&runner);
}

TEST(objects_of_a_class_share_its_reflectors_and_the_ego_has_none)
{
    struct frame frame;
    struct runner runner;
    begin_stage(&runner, "extract", NO_WORDS);
    make_frame(&frame, check_arena());
    assert_int_equal(step(&frame, &runner, NULL), 0);
    assert_int_equal(frame.reflectors.count, 2);
    const struct reflector_set *cars = &frame.reflectors.items[0];
    assert_string_equal(cars->model, "car");
    assert_int_equal(cars->objects.count, 2);
    assert_string_equal(cars->objects.items[0], "a");
    assert_string_equal(cars->objects.items[1], "z");
    assert_int_equal(cars->points.count,
                     runner_vehicle(&runner, NULL, "car")->reflectors.points.count);
    assert_string_equal(frame.reflectors.items[1].objects.items[0], "b");
    assert_int_equal(frame.vehicles.count, 2);
    assert_string_equal(frame.vehicles.items[0].digest,
                        runner_vehicle(&runner, NULL, "car")->digest);
    runner_free(&runner);
}

/* Names the only point of the set after the class. */
static void describe(const void *state, const struct vehicle *vehicle, struct reflector_set *set,
                     struct arena *arena)
{
    assert_null(((const struct extraction *)state)->vehicles);
    memset(&set->points, 0, sizeof set->points);
    list_add(&set->points, arena)->name = vehicle->reflectors.model;
}

TEST(a_description_takes_the_place_of_the_documents_reflectors)
{
    struct frame frame;
    struct runner runner;
    begin_stage(&runner, "extract", NO_WORDS);
    make_frame(&frame, check_arena());
    assert_int_equal(step(&frame, &runner, describe), 0);
    for (size_t i = 0; i < 2; i++) {
        const struct reflector_set *set = &frame.reflectors.items[i];
        assert_int_equal(set->points.count, 1);
        assert_string_equal(set->points.items[0].name, set->model);
    }
    assert_true(runner_vehicle(&runner, NULL, "car")->reflectors.points.count > 1);
    runner_free(&runner);
}

TEST(the_message_names_the_object_as_the_frame_numbers_it)
{
    struct frame frame;
    struct runner runner;
    begin_stage(&runner, "extract", NO_WORDS);
    make_frame(&frame, check_arena());
    frame.objects.items[2].class = "hovercraft";
    assert_int_equal(step(&frame, &runner, NULL), -1);
    assert_non_null(strstr(runner.diag.text, "objects[2].class: there is no vehicles/hovercraft"));
    runner_free(&runner);
}

/* As when a stream that was extracted with other documents is extracted again. */
TEST(a_frame_keeps_to_the_documents_that_it_was_extracted_with)
{
    struct frame frame;
    struct runner runner;
    begin_stage(&runner, "extract", NO_WORDS);
    make_frame(&frame, check_arena());
    *list_add(&frame.vehicles, check_arena()) =
        (struct class_document){.class = "car", .digest = "0123456789abcdef"};
    assert_int_equal(step(&frame, &runner, NULL), -1);
    assert_non_null(strstr(runner.diag.text, "0123456789abcdef"));
    runner_free(&runner);
}

TEST(a_folder_that_is_not_there_is_refused_at_the_start)
{
    struct runner runner;
    assert_int_equal(runner_prepare(&runner, stage_by_name("extract"), 2,
                                    (const char *[]){"--vehicles", "nowhere"}),
                     0);
    assert_int_equal(extraction_start(runner.state, &runner), -1);
    assert_string_equal(runner.diag.text, "--vehicles: \"nowhere\" is no folder");
    runner_free(&runner);
}
