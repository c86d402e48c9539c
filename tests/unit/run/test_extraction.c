#include "run_bench.h"

#include "run/extraction.h"

/* A stage that has begun and a frame of two cars, a truck and the ego, another car. */
struct bench {
    struct arena arena;
    struct runner runner;
    struct frame frame;
};

static int make_bench(void **state)
{
    static const char *const objects[][2] = {
        {"z", "car"}, {"ego", "car"}, {"b", "truck"}, {"a", "car"}};
    struct bench *bench = check_make(state, sizeof *bench);
    begin_stage(&bench->runner, "extract", NO_WORDS);
    bench->frame = (struct frame){.ego = "ego", .present = PART_OBJECTS, .arena = &bench->arena};
    for (size_t i = 0; i < COUNT(objects); i++)
        *list_add(&bench->frame.objects, &bench->arena) =
            (struct object){.id = objects[i][0], .class = objects[i][1]};
    return 0;
}

static int remove_bench(void **state)
{
    struct bench *bench = *state;
    runner_free(&bench->runner);
    arena_free(&bench->arena);
    free(bench);
    return 0;
}

/* One step on the frame: its result. */
static int step(struct bench *bench, extraction_describe *describe)
{
    return extraction_step(bench->runner.state, &bench->frame, &bench->runner, describe, NULL);
}

static const struct vehicle *car_of(struct bench *bench)
{
    return runner_vehicle(&bench->runner, NULL, "car", NULL);
}

#define EXTRACTION_TEST(name) TEST_WITH(make_bench, remove_bench, struct bench *bench, name)

EXTRACTION_TEST(sizes_of_zero_are_those_of_the_class)
{
    bench->frame.objects.items[0].width_m = 2.5;
    assert_int_equal(step(bench, NULL), 0);
    const struct vehicle *car = car_of(bench);
    assert_close(bench->frame.objects.items[0].length_m, car->length_m, 0);
    assert_close(bench->frame.objects.items[0].width_m, 2.5, 0);
    assert_close(bench->frame.objects.items[0].height_m, car->height_m, 0);
    assert_close(bench->frame.objects.items[1].width_m, car->width_m, 0); /* the ego's, too */
    assert_true(bench->frame.objects.items[2].length_m > car->length_m);
}

EXTRACTION_TEST(objects_of_a_class_share_its_reflectors_and_the_ego_has_none)
{
    assert_int_equal(step(bench, NULL), 0);
    assert_int_equal(bench->frame.reflectors.count, 2);
    const struct reflector_set *cars = &bench->frame.reflectors.items[0];
    assert_string_equal(cars->model, "car");
    assert_int_equal(cars->objects.count, 2);
    assert_string_equal(cars->objects.items[0], "a");
    assert_string_equal(cars->objects.items[1], "z");
    assert_int_equal(cars->points.count, car_of(bench)->reflectors.points.count);
    assert_string_equal(bench->frame.reflectors.items[1].objects.items[0], "b");
    assert_int_equal(bench->frame.vehicles.count, 2);
    assert_string_equal(bench->frame.vehicles.items[0].digest, car_of(bench)->digest);
}

/* Names the only point of the set after the class. */
static void describe(const void *state, const struct vehicle *vehicle, struct reflector_set *set,
                     struct arena *arena)
{
    assert_null(((const struct extraction *)state)->vehicles);
    memset(&set->points, 0, sizeof set->points);
    list_add(&set->points, arena)->name = vehicle->reflectors.model;
}

EXTRACTION_TEST(a_description_takes_the_place_of_the_documents_reflectors)
{
    assert_int_equal(step(bench, describe), 0);
    for (size_t i = 0; i < 2; i++) {
        const struct reflector_set *set = &bench->frame.reflectors.items[i];
        assert_int_equal(set->points.count, 1);
        assert_string_equal(set->points.items[0].name, set->model);
    }
    assert_true(car_of(bench)->reflectors.points.count > 1);
}

/* Gives a car one point that is named after the object. */
static bool describe_body(void *state, const struct vehicle *vehicle, const struct frame *frame,
                          const struct object *object, struct reflector_set *set)
{
    (void)state;
    if (strcmp(vehicle->reflectors.model, "car") != 0)
        return false;
    *set = (struct reflector_set){.model = vehicle->reflectors.model};
    list_add(&set->points, frame->arena)->name = object->id;
    return true;
}

EXTRACTION_TEST(an_object_may_have_reflectors_of_its_own)
{
    assert_int_equal(
        extraction_step(bench->runner.state, &bench->frame, &bench->runner, NULL, describe_body),
        0);
    static const char *const owners[] = {"a", "b", "z"};
    assert_int_equal(bench->frame.reflectors.count, COUNT(owners));
    for (size_t i = 0; i < COUNT(owners); i++) {
        const struct reflector_set *set = &bench->frame.reflectors.items[i];
        assert_int_equal(set->objects.count, 1);
        assert_string_equal(set->objects.items[0], owners[i]);
        bool own = strcmp(set->model, "car") == 0;
        assert_true(own == (set->points.count == 1));
        if (own)
            assert_string_equal(set->points.items[0].name, owners[i]);
    }
}

/* The points of a car of this size in a frame of a scene, by their number, facings and heights. */
static double points_of_car(struct runner *runner, const char *scene, double length_m,
                            double height_m)
{
    struct arena arena = {0};
    struct frame frame = {
        .scene = scene, .seed = 1, .ego = "ego", .present = PART_OBJECTS, .arena = &arena};
    *list_add(&frame.objects, &arena) = (struct object){
        .id = "a", .class = "car", .length_m = length_m, .width_m = 1.8, .height_m = height_m};
    assert_int_equal(runner->stage->step(runner->state, &frame, runner), 0);
    const struct reflector_set *set = &frame.reflectors.items[0];
    double sum = (double)set->points.count;
    for (size_t i = 0; i < set->points.count; i++)
        sum += (double)(i + 1) * (set->points.items[i].facing_rad + set->points.items[i].z);
    arena_free(&arena);
    return sum;
}

TEST(a_surface_follows_the_scene_and_the_size_of_its_body)
{
    struct runner runner, other;
    begin_stage(&runner, "extract", WORDS("--vehicles", "surfaces"));
    begin_stage(&other, "extract", WORDS("--vehicles", "surfaces"));
    double car = points_of_car(&runner, "one", 4.5, 1.5);
    double longer = points_of_car(&runner, "one", 6, 1.5);
    assert_close(points_of_car(&other, "one", 6, 1.5), longer, 0);
    assert_true(longer != car);
    double taller = points_of_car(&runner, "one", 4.5, 2);
    assert_close(points_of_car(&other, "one", 4.5, 2), taller, 0);
    assert_true(taller != car);
    assert_close(points_of_car(&runner, "one", 4.5, 1.5), car, 0);
    assert_true(points_of_car(&runner, "two", 4.5, 1.5) != car);
    assert_close(points_of_car(&runner, "one", 4.5, 1.5), car, 0);
    runner_free(&runner);
    runner_free(&other);
}

EXTRACTION_TEST(the_message_names_the_object_as_the_frame_numbers_it)
{
    bench->frame.objects.items[2].class = "hovercraft";
    assert_int_equal(step(bench, NULL), -1);
    assert_non_null(
        strstr(bench->runner.diag.text, "objects[2].class: there is no vehicles/hovercraft"));
}

/* As when a stream that was extracted with other documents is extracted again. */
EXTRACTION_TEST(a_frame_keeps_to_the_documents_that_it_was_extracted_with)
{
    *list_add(&bench->frame.vehicles, &bench->arena) =
        (struct class_document){.class = "car", .digest = "0123456789abcdef"};
    assert_int_equal(step(bench, NULL), -1);
    assert_non_null(strstr(bench->runner.diag.text, "0123456789abcdef"));
}

EXTRACTION_TEST(documents_that_the_frame_names_are_not_named_again)
{
    const char *digest = car_of(bench)->digest;
    *list_add(&bench->frame.vehicles, &bench->arena) =
        (struct class_document){.class = "car", .digest = digest};
    assert_int_equal(step(bench, NULL), 0);
    assert_int_equal(bench->frame.vehicles.count, 2);
    assert_string_equal(bench->frame.vehicles.items[1].class, "truck");
}

TEST(a_folder_that_is_not_there_is_refused_at_the_start)
{
    struct runner runner;
    assert_int_equal(runner_prepare(&runner, stage_by_name("extract"), 2,
                                    (const char *[]){"--vehicles", "./nowhere"}),
                     0);
    assert_int_equal(extraction_start(runner.state, &runner), -1);
    assert_string_equal(runner.diag.text, "--vehicles: \"./nowhere\" is no folder");
    runner_free(&runner);
}
