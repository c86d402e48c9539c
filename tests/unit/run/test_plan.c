#include "check.h"

#include <stdio.h>
#include <string.h>

#include "run/plan.h"

#define EVERY (EFFECT_BIT(EFFECT_COUNT) - 1)

static struct plan plan_of(const char *sensors)
{
    return (struct plan){
        .sensors = sensors,
        .allowed = EVERY,
        .frames = 3,
        .positions = {{.program = "glint-ideal", .section = SECTION_ECHOES, .log.scans = 9},
                      {.program = "glint-sensor",
                       .stand_in = "glint-sensor-perfect",
                       .section = SECTION_CELLS,
                       .log.scans = 9},
                      {.program = "glint-noise",
                       .stand_in = "glint-noise-none",
                       .section = SECTION_TARGETS,
                       .log.scans = 9}},
    };
}

static void assert_writes(const struct plan *plan, bool all, const char *part, bool expected)
{
    struct arena arena = {0};
    struct text text = {0};
    plan_write(plan, all, &arena, &text);
    text_add(&text, "", 1);
    if ((strstr(text.bytes, part) != NULL) != expected)
        fail_msg("\"%s\" is %sin:\n%s", part, expected ? "not " : "", text.bytes);
    text_free(&text);
    arena_free(&arena);
}

static void a_request_decides_as_auto_does_among_what_is_allowed(void **state)
{
    (void)state;
    static const char *const texts[] = {"auto", "none", "all,-rows", "occlusion,merging"};
    struct arena arena = {0};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct selection asked, planned;
        struct diag diag = {0};
        assert_int_equal(effects_read(texts[i], &asked, &diag), 0);
        const char *request = plan_request(asked.allowed, &arena);
        assert_int_equal(effects_read(request, &planned, &diag), 0);
        assert_int_equal(planned.allowed, asked.allowed);
        assert_true(planned.automatic);
    }
    arena_free(&arena);
}

static void an_effect_is_asked_for_if_any_scan_needed_it(void **state)
{
    (void)state;
    struct plan plan = plan_of("radar");
    plan.positions[PLAN_IDEAL].log.scans_simulated[EFFECT_OCCLUSION] = 1;
    plan.positions[PLAN_IDEAL].log.scans_left_out[EFFECT_OCCLUSION] = 8;
    plan.positions[PLAN_IDEAL].log.scans_left_out[EFFECT_ROWS] = 9;
    plan.positions[PLAN_SENSOR].log.scans_left_out[EFFECT_THRESHOLD] = 9;
    plan.positions[PLAN_SENSOR].differs = plan.positions[PLAN_NOISE].differs = true;
    plan.positions[PLAN_SENSOR].scene = plan.positions[PLAN_NOISE].scene = "a";
    assert_int_equal(plan_effects(&plan), EFFECT_BIT(EFFECT_OCCLUSION));
    assert_writes(&plan, true, " --sensors radar --effects occlusion \\\n", true);
    assert_writes(&plan, true,
                  "occlusion         on in 1 of 9 scans: blocks of a vehicle; in the others "
                  "no object stands between the sensor and another object\n",
                  true);
    assert_writes(&plan, true, "rows              off: no object has rows\n", true);
    assert_writes(&plan, true, "merging           off: nothing describes it", true);
    assert_writes(&plan, true, "threshold         off: nothing describes it", true);
}

static void effects_that_are_off_are_counted_unless_all_are_asked_for(void **state)
{
    (void)state;
    struct plan plan = plan_of("radar");
    plan.positions[PLAN_IDEAL].log.scans_simulated[EFFECT_OCCLUSION] = 1;
    plan.positions[PLAN_IDEAL].log.scans_left_out[EFFECT_OCCLUSION] = 8;
    char count[64];
    snprintf(count, sizeof count, "# %d others are off; --all says why\n", EFFECT_COUNT - 1);
    assert_writes(&plan, false, "occlusion         on in 1 of 9 scans: blocks of a vehicle\n",
                  true);
    assert_writes(&plan, false, "# rows ", false);
    assert_writes(&plan, false, count, true);
    assert_writes(&plan, true, "others are off", false);
}

static void without_effects_none_is_asked_for(void **state)
{
    (void)state;
    struct plan plan = plan_of("radar");
    assert_int_equal(plan_effects(&plan), 0);
    assert_writes(&plan, true, " --effects none \\\n", true);
}

static void what_was_not_asked_for_says_so(void **state)
{
    (void)state;
    struct plan plan = plan_of("radar");
    plan.allowed &= ~EFFECT_BIT(EFFECT_ROWS);
    assert_writes(&plan, true, "rows              off: not asked for\n", true);
}

static void a_stage_goes_with_its_effects_where_another_does_the_same(void **state)
{
    (void)state;
    struct plan plan = plan_of("radar");
    struct plan_position *sensor = &plan.positions[PLAN_SENSOR];
    sensor->log.scans_simulated[EFFECT_THRESHOLD] = 9;
    plan.positions[PLAN_NOISE].log.scans_simulated[EFFECT_FINAL_THRESHOLD] = 9;
    assert_int_equal(plan_effects(&plan), 0);
    assert_writes(&plan, true, "  | glint-sensor-perfect \\\n  | glint-noise-none\n", true);
    sensor->differs = true;
    sensor->scene = "cut-in/ego";
    sensor->frame = 7;
    assert_int_equal(plan_effects(&plan), EFFECT_BIT(EFFECT_THRESHOLD));
    assert_writes(&plan, true, "  | glint-sensor \\\n  | glint-noise-none\n", true);
    assert_writes(&plan, true, "first in frame 7 of scene \"cut-in/ego\"\n", true);
}

/* Names come from documents: none may end the comment or the word that it stands in. */
static void names_stay_in_their_place(void **state)
{
    (void)state;
    struct plan plan = plan_of("it's $HOME");
    plan.positions[PLAN_SENSOR].differs = true;
    plan.positions[PLAN_SENSOR].scene = "a\nreboot";
    assert_writes(&plan, true, "--sensors 'it'\\''s $HOME' --effects", true);
    assert_writes(&plan, true, "of scene \"a\\u000areboot\"\n", true);
    assert_writes(&plan, true, "\nreboot", false);
}

static void no_frames_make_no_plan(void **state)
{
    (void)state;
    struct plan plan = plan_of("radar");
    struct arena arena = {0};
    struct text text = {0};
    plan.frames = 0;
    plan_write(&plan, true, &arena, &text);
    assert_int_equal(text.length, 0);
    text_free(&text);
}

/* A frame with one cell. */
static void make_frame(struct frame *frame, struct arena *arena, double range_m, double azimuth_rad)
{
    *frame = (struct frame){.arena = arena};
    frame_clear(frame);
    frame->scene = "s";
    frame->ego = "e";
    frame->frame = 4;
    frame->present = SECTION_CELLS;
    struct cell *cell = list_add(&frame->cells, arena);
    *cell = (struct cell){.sensor = "front", .range_m = range_m, .azimuth_rad = azimuth_rad};
    *list_add(&cell->members, arena) =
        (struct contributor){.id.object = "o", .id.reflector = "r", .weight = 1};
}

static void frames_are_compared_in_every_value(void **state)
{
    (void)state;
    static const struct {
        double range_m, azimuth_rad;
        bool differs;
    } cases[] = {{10, 0.5, false}, {10, 0.25, true}, {10.000000000000002, 0.5, true}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena one = {0}, other = {0}, kept = {0};
        struct frame made, stand_in_made;
        make_frame(&made, &one, 10, 0.5);
        make_frame(&stand_in_made, &other, cases[i].range_m, cases[i].azimuth_rad);
        struct plan plan = plan_of("radar");
        struct plan_position *sensor = &plan.positions[PLAN_SENSOR];
        plan_compare(sensor, &made, &stand_in_made, &kept);
        assert_int_equal(sensor->differs, cases[i].differs);
        if (sensor->differs) {
            assert_string_equal(sensor->scene, "s");
            assert_int_equal(sensor->frame, 4);
        }
        arena_free(&one);
        arena_free(&other);
        arena_free(&kept);
    }
}

static void a_cell_more_is_a_difference(void **state)
{
    (void)state;
    struct arena one = {0}, other = {0}, kept = {0};
    struct frame made, stand_in_made;
    make_frame(&made, &one, 10, 0.5);
    make_frame(&stand_in_made, &other, 10, 0.5);
    made.cells.count = 0;
    struct plan plan = plan_of("radar");
    plan_compare(&plan.positions[PLAN_SENSOR], &made, &stand_in_made, &kept);
    assert_true(plan.positions[PLAN_SENSOR].differs);
    arena_free(&one);
    arena_free(&other);
    arena_free(&kept);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_request_decides_as_auto_does_among_what_is_allowed),
        cmocka_unit_test(an_effect_is_asked_for_if_any_scan_needed_it),
        cmocka_unit_test(effects_that_are_off_are_counted_unless_all_are_asked_for),
        cmocka_unit_test(without_effects_none_is_asked_for),
        cmocka_unit_test(what_was_not_asked_for_says_so),
        cmocka_unit_test(a_stage_goes_with_its_effects_where_another_does_the_same),
        cmocka_unit_test(names_stay_in_their_place),
        cmocka_unit_test(no_frames_make_no_plan),
        cmocka_unit_test(frames_are_compared_in_every_value),
        cmocka_unit_test(a_cell_more_is_a_difference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
