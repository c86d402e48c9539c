#include "run_bench.h"

#include "run/suite_choice.h"

static const char suite_name[] = "srr24-pair-every-frame";

struct bench {
    struct runner runner; /* of glint-noise */
    const struct suite *suite;
    struct arena arena;
    struct frame frame; /* as glint-ideal writes it: suite, digest and views */
};

static int begin(void **state)
{
    struct bench *bench = check_make(state, sizeof *bench);
    bench->frame.arena = &bench->arena;
    begin_stage(&bench->runner, "noise", NO_WORDS);
    bench->suite = suite_choice_load(&bench->runner, suite_name);
    assert_non_null(bench->suite);
    bench->frame.sensors.suite = bench->suite->name;
    bench->frame.sensors.digest = bench->suite->digest;
    for (size_t i = 0; i < bench->suite->sensors.count; i++)
        *list_add(&bench->frame.sensors.list, &bench->arena) =
            (struct sensor_view){.name = bench->suite->sensors.items[i].name, .measured = i == 0};
    return 0;
}

static int end(void **state)
{
    struct bench *bench = *state;
    arena_free(&bench->arena);
    runner_free(&bench->runner);
    free(bench);
    return 0;
}

#define NOISE_TEST(name) TEST_WITH(begin, end, struct bench *bench, name)

static void expect_refused(struct bench *bench, enum diag_code code, const char *message)
{
    assert_int_equal(bench->runner.diag.code, code);
    if (strstr(bench->runner.diag.text, message) == NULL)
        fail_msg("\"%s\" is not in: %s", message, bench->runner.diag.text);
    bench->runner.diag = (struct diag){0};
}

TEST(the_option_goes_before_the_suite_and_the_suite_before_auto)
{
    static const char *const cases[][3] = {/* option, suite, request */
                                           {"none", "rows", "none"},
                                           {NULL, "rows", "rows"},
                                           {NULL, NULL, "auto"}};
    for (size_t i = 0; i < 3; i++) {
        struct suite suite = {.name = "a", .digest = "d", .effects = cases[i][1]};
        struct suite_choice choice = {.effects = cases[i][0]};
        struct sensors request;
        assert_done(suite_choice_request, &choice, &suite, &request);
        assert_string_equal(request.effects, cases[i][2]);
        assert_string_equal(request.suite, "a");
        assert_string_equal(request.digest, "d");
    }
}

TEST(an_unknown_effect_is_a_fault_of_whoever_names_it)
{
    struct suite suite = {.name = "a", .digest = "d", .effects = "rain,snew"};
    struct suite_choice choice = {.effects = "rian"};
    struct sensors request;
    struct diag of_option = {0}, of_suite = {0};
    assert_int_equal(suite_choice_request(&choice, &suite, &request, &of_option), -1);
    assert_int_equal(of_option.code, DIAG_USAGE);
    assert_memory_equal(of_option.text, "--effects: ", 11);
    choice.effects = NULL;
    assert_int_equal(suite_choice_request(&choice, &suite, &request, &of_suite), -1);
    assert_int_not_equal(of_suite.code, DIAG_USAGE);
    assert_memory_equal(of_suite.text, "effects: ", 9);
}

NOISE_TEST(a_stage_takes_the_suite_that_the_frame_was_seen_with)
{
    struct suite_choice own = {0}, given = {.sensors = suite_name}, other = {.sensors = "lrr77"};
    assert_ptr_equal(suite_choice_suite(&own, &bench->frame, &bench->runner), bench->suite);
    assert_ptr_equal(suite_choice_suite(&given, &bench->frame, &bench->runner), bench->suite);
    assert_null(suite_choice_suite(&other, &bench->frame, &bench->runner));
    expect_refused(bench, DIAG_CONFIG, "sensors.digest: the frame was seen with ");
    bench->frame.sensors.digest = "0123456789abcdef";
    assert_null(suite_choice_suite(&own, &bench->frame, &bench->runner));
    expect_refused(bench, DIAG_CONFIG,
                   "seen with, 0123456789abcdef; give its path (--sensors PATH)");
}

NOISE_TEST(frame_and_suite_have_the_same_sensors)
{
    struct suite_choice choice = {0};
    bench->frame.sensors.list.count = 1;
    assert_null(suite_choice_suite(&choice, &bench->frame, &bench->runner));
    expect_refused(bench, DIAG_DATA, "sensors.list: 1 sensors; the suite ");
    bench->frame.sensors.list.count = 2;
    bench->frame.sensors.list.items[1].name = "roof";
    assert_null(suite_choice_suite(&choice, &bench->frame, &bench->runner));
    expect_refused(bench, DIAG_DATA, "sensors.list[1].name: \"roof\" is not in the suite ");
}

NOISE_TEST(effects_are_those_that_the_frame_was_seen_with)
{
    struct selection selection;
    struct suite_choice own = {0}, same = {.effects = "rain,snow"}, other = {.effects = "rain"};
    assert_int_equal(suite_choice_effects(&own, &bench->frame, &bench->runner, &selection), 0);
    assert_true(selection.automatic);
    bench->frame.sensors.effects = "rain,snow";
    assert_int_equal(suite_choice_effects(&same, &bench->frame, &bench->runner, &selection), 0);
    assert_int_equal(selection.allowed, EFFECT_BIT(EFFECT_RAIN) | EFFECT_BIT(EFFECT_SNOW));
    assert_int_equal(suite_choice_effects(&other, &bench->frame, &bench->runner, &selection), -1);
    expect_refused(bench, DIAG_CONFIG, "seen with \"rain,snow\", not with \"rain\"; give the ");
    bench->frame.sensors.effects = "rian";
    assert_int_equal(suite_choice_effects(&own, &bench->frame, &bench->runner, &selection), -1);
    expect_refused(bench, DIAG_CONFIG, "sensors.effects: ");
}

/* The suite's cells are 0.3 m. */
NOISE_TEST(reflectors_that_are_made_for_finer_cells_are_doubted)
{
    struct frame *frame = &bench->frame;
    list_add(&frame->vehicles, &bench->arena)->class = "car";
    list_add(&frame->vehicles, &bench->arena)->class = "van";
    list_add(&frame->reflectors, &bench->arena)->model = "car";
    assert_false(suite_choice_doubt_cells(&bench->runner, bench->suite, frame));
    frame->vehicles.items[0].cell_max_m = 0.29999999; /* as good as equal */
    frame->vehicles.items[1].cell_max_m = 0.2;        /* but no van reflects */
    assert_false(suite_choice_doubt_cells(&bench->runner, bench->suite, frame));
    assert_int_equal(bench->runner.notices.count, 0);
    frame->vehicles.items[0].cell_max_m = 0.2999996;
    assert_true(suite_choice_doubt_cells(&bench->runner, bench->suite, frame));
    assert_true(suite_choice_doubt_cells(&bench->runner, bench->suite, frame));
    assert_int_equal(bench->runner.notices.count, 1);
    assert_string_equal(
        bench->runner.notices.items[0],
        "srr24-pair-every-frame: sensors[0].cell_range_m: doubt: cells of 0.3 m; "
        "the reflectors of the class \"car\" are made for cells of at most 0.2999996 m; "
        "for larger ones take --vehicles detailed");
}

/* Counts the visit at its sensor, and notes an effect. */
static void visit(struct frame *frame, const struct sensor *sensor,
                  const struct selection *selection)
{
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        if (strcmp(frame->sensors.list.items[i].name, sensor->name) == 0)
            frame->sensors.list.items[i].cycle_s += 1;
    effects_note(selection, EFFECT_RAIN, true);
}

NOISE_TEST(every_sensor_is_visited_once_and_only_scans_are_noted)
{
    struct effect_log log = {0};
    static const struct stage stage = {.name = "visitor", .visit = visit};
    bench->runner.log = &log;
    bench->runner.stage = &stage;
    assert_int_equal(suite_choice_step(&(struct suite_choice){0}, &bench->frame, &bench->runner),
                     0);
    assert_int_equal(bench->frame.sensors.list.count, 2);
    for (size_t i = 0; i < 2; i++)
        assert_close(bench->frame.sensors.list.items[i].cycle_s, 1, 0);
    assert_int_equal(log.scans, 1);
    assert_int_equal(log.scans_simulated[EFFECT_RAIN], 1);
}
