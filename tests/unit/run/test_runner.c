#define SCRATCH_FILE "told"
#include "scratch.h"

#include "effects/effect.h"
#include "frame/frame_text.h"
#include "run/extraction.h"
#include "run_bench.h"

static void begin(struct runner *runner, const struct stage *stage, size_t count,
                  const char *const *words)
{
    if (runner_prepare(runner, stage, count, words) != 0 || runner_start(runner) != 0)
        fail_msg("%s: %s", stage->name, runner->diag.text);
}

/* Whoever writes reflectors completes sizes, by documents that were checked (extraction_step). */
static void forget_sizes(struct frame *frame, struct arena *arena)
{
    struct object *objects = arena_room(arena, frame->objects.count * sizeof *objects);
    for (size_t i = 0; i < frame->objects.count; i++) {
        objects[i] = frame->objects.items[i];
        objects[i].length_m = objects[i].width_m = objects[i].height_m = 0;
    }
    frame->objects.items = objects;
}

/* The frame as text, without the part that the stage may change. */
static void write_rest(const struct frame *frame, unsigned present, const struct stage *stage,
                       struct text *text)
{
    struct frame rest = *frame;
    memset(&rest.lost, 0, sizeof rest.lost);
    for (size_t i = 0; i < frame->lost.count; i++)
        if (strcmp(frame->lost.items[i].stage, stage->name) != 0)
            *list_add(&rest.lost, check_arena()) = frame->lost.items[i];
    rest.present = present & ~(stage->writes & ~(unsigned)PART_LOST);
    if ((stage->writes & PART_REFLECTORS) != 0)
        forget_sizes(&rest, check_arena());
    text->length = 0;
    assert_done(frame_text_write, &rest, text);
    text_add(text, "", 1);
}

/* Steps and says whether the stage kept to what it declares. */
static bool keeps_to_its_part(struct runner *runner, struct frame *frame)
{
    const struct stage *stage = runner->stage;
    struct text *before = check_text(), *after = check_text();
    frame_drop(frame, stage->writes & ~stage->reads & ~(unsigned)(PART_LOST | PART_COUNTS));
    unsigned present = frame->present;
    write_rest(frame, present, stage, before);
    if (runner_step(runner, frame) != 0)
        fail_msg("%s: %s", stage->name, runner->diag.text);
    write_rest(frame, present, stage, after);
    return strcmp(before->bytes, after->bytes) == 0;
}

static bool is_filter(const struct stage *stage)
{
    return stage_kind(stage) == STAGE_FILTER;
}

/* The signal is simulated only for sensors that have a waveform. */
static bool fits(const struct stage *stage, const char *suite)
{
    return strcmp(stage->name, "sensor-signal") != 0 || strstr(suite, "-signal") != NULL;
}

/* The chain itself, then every other filter in place of what wrote its parts: frames then have
 * what a later stage needs. */
static size_t order_filters(const char *suite, const struct stage **filters)
{
    static const char *const chain[] = {"extract", "ideal", "sensor", "noise"};
    size_t count = 0;
    for (; count < COUNT(chain); count++)
        filters[count] = stage_by_name(chain[count]);
    for (size_t i = 0; stages[i] != NULL; i++) {
        bool known = !is_filter(stages[i]) || !fits(stages[i], suite);
        for (size_t j = 0; j < COUNT(chain) && !known; j++)
            known = stages[i] == filters[j];
        if (!known)
            filters[count++] = stages[i];
    }
    return count;
}

static void run_filters(const char *suite, const char *density)
{
    struct runner source, runners[64];
    const struct stage *filters[64];
    size_t count = order_filters(suite, filters);
    struct frame frame = {.arena = check_arena()};
    begin(&source, stage_by_name("traffic-random"), 7,
          (const char *[]){"--density", density, "--draw-conditions", "--frames", "20",
                           "--sections", "all"});
    for (size_t i = 0; i < count; i++)
        begin(&runners[i], filters[i], strcmp(filters[i]->name, "ideal") == 0 ? 2 : 0,
              (const char *[]){"--sensors", suite});
    while (runner_next(&source, &frame) == 1)
        for (size_t i = 0; i < count; i++) {
            /* What stands in takes from what it replaces the echoes that it accounts for. */
            if (i >= 4) {
                frame.sections &= ~(uint64_t)CARRY_ACCOUNT;
                frame_drop(&frame, PART_LOST);
            }
            if (!keeps_to_its_part(&runners[i], &frame))
                fail_msg("glint-%s changed what it does not declare", filters[i]->name);
        }
    for (size_t i = 0; i < count; i++)
        runner_free(&runners[i]);
    runner_free(&source);
}

TEST(no_stage_changes_what_it_does_not_declare)
{
    static const char *const suites[] = {"corner77-every-frame", "lrr77-full", "lrr77-coherent",
                                         "lrr77-signal-small"};
    for (size_t i = 0; i < COUNT(suites); i++) {
        run_filters(suites[i], "dense");
        run_filters(suites[i], "medium");
    }
}

/* Objects move behind the back of whoever reads `writes`. */
static int meddle(void *state, struct frame *frame, struct runner *runner)
{
    (void)state;
    (void)runner;
    frame->objects.items[0].x_m += 1;
    return 0;
}

static int write_negative_length(void *state, struct frame *frame, struct runner *runner)
{
    (void)state;
    (void)runner;
    frame->objects.items[1].length_m = -1;
    return 0;
}

static void begin_frame(struct frame *frame)
{
    struct runner source;
    begin(&source, stage_by_name("traffic-random"), 2, (const char *[]){"--density", "dense"});
    assert_int_equal(runner_next(&source, frame), 1);
    runner_free(&source);
}

TEST(a_change_that_is_not_declared_is_found)
{
    struct frame frame = {.arena = check_arena()};
    struct stage stage = {
        .name = "meddle", .options = STAGE_OPTIONS(int, field_none), .step = meddle};
    struct runner runner;
    begin_frame(&frame);
    begin(&runner, &stage, 0, NULL);
    assert_false(keeps_to_its_part(&runner, &frame));
    stage.reads = stage.writes = PART_OBJECTS;
    assert_true(keeps_to_its_part(&runner, &frame));
    runner_free(&runner);
}

TEST(a_stage_that_writes_an_invalid_frame_fails_itself)
{
    struct frame frame = {.arena = check_arena()};
    const struct stage stage = {.name = "invalid",
                                .options = STAGE_OPTIONS(int, field_none),
                                .reads = PART_OBJECTS,
                                .writes = PART_OBJECTS,
                                .step = write_negative_length};
    struct runner runner;
    begin_frame(&frame);
    begin(&runner, &stage, 0, NULL);
    assert_int_equal(runner_step(&runner, &frame), -1);
    assert_int_equal(runner.diag.code, DIAG_INTERNAL);
    assert_string_equal(runner.diag.text,
                        "wrote an invalid frame: objects[1].length_m: -1 is outside [0, 1e6] m");
    runner_free(&runner);
}

static int delay(void *state, struct frame *frame, struct runner *runner)
{
    (void)state;
    (void)runner;
    frame->time_s += 0.5;
    return 0;
}

/* The line that a frame was read from passes word for word, but for what a stage changed. */
TEST(a_header_that_a_stage_changed_is_written_as_it_is)
{
    struct frame made = {.arena = check_arena()}, frame = {.arena = check_arena()};
    struct text *line = check_text(), *out = check_text();
    const struct stage stage = {
        .name = "delay", .options = STAGE_OPTIONS(int, field_none), .step = delay};
    struct runner runner;
    begin_frame(&made);
    made.time_s = 2;
    assert_done(frame_text_write, &made, line);
    assert_done(frame_text_take, line->bytes, line->length - 1, 0, &frame);
    begin(&runner, &stage, 0, NULL);
    assert_int_equal(runner_step(&runner, &frame), 0);
    assert_done(frame_text_write, &frame, out);
    text_add(out, "", 1);
    assert_non_null(strstr(out->bytes, "\"time_s\":2.5,"));
    runner_free(&runner);
}

static void describe_negative_ercs(const void *state, const struct vehicle *vehicle,
                                   struct reflector_set *set, struct arena *arena)
{
    (void)state;
    (void)vehicle;
    memset(&set->points, 0, sizeof set->points);
    struct point_reflector *point = list_add(&set->points, arena);
    *point = (struct point_reflector){.name = "glare", .ercs = -1};
}

static int extract_negative_ercs(void *state, struct frame *frame, struct runner *runner)
{
    return extraction_step(state, frame, runner, describe_negative_ercs, NULL);
}

/* A document's reflectors were checked when it was read; others in their place were not. */
TEST(a_list_in_place_of_the_documents_is_checked)
{
    struct frame frame = {.arena = check_arena()};
    const struct stage stage = {.name = "invalid",
                                .options = &extraction_record,
                                .reads = PART_OBJECTS,
                                .writes = PART_OBJECTS | PART_REFLECTORS,
                                .step = extract_negative_ercs};
    struct runner runner;
    begin_frame(&frame);
    begin(&runner, &stage, 0, NULL);
    assert_int_equal(runner_step(&runner, &frame), -1);
    assert_string_equal(
        runner.diag.text,
        "wrote an invalid frame: reflectors[0].points[0].ercs: -1 is outside [0, 1000]");
    runner_free(&runner);
}
