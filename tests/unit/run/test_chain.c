#define SCRATCH_FILE "told"
#include "scratch.h"

#include "captured.h"
#include "run/chain.h"
#include "run_bench.h"

/* Stages of this file: a source of three frames, and filters that fail. */
struct made {
    int64_t frames;
};

static const struct field no_fields[] = {{0}};
static const struct record count_record = {
    .name = "count", .size = sizeof(struct made), .fields = no_fields};

static int next(void *state, struct frame *frame, struct runner *runner)
{
    struct made *own = state;
    (void)runner;
    if (own->frames == 3)
        return 0;
    frame->scene = "s";
    frame->ego = "e";
    frame->interval_s = 1;
    frame->frame = own->frames++;
    list_add(&frame->objects, frame->arena)->id = "e";
    frame->objects.items[0].class = "car";
    return 1;
}

static int turn(void *state, struct frame *frame, struct runner *runner)
{
    (void)state;
    (void)runner;
    frame->objects.items[0].yaw_rad = 0.5;
    return 0;
}

static int fail_at_second(void *state, struct frame *frame, struct runner *runner)
{
    (void)state;
    return frame->frame == 1 ? diag_fail(runner_diag(runner), DIAG_DATA, "no more") : 0;
}

static int fail_at_stop(void *state, struct runner *runner)
{
    (void)state;
    return diag_fail(runner_diag(runner), DIAG_CONFIG, "at the end");
}

static int pass(void *state, struct frame *frame, struct runner *runner)
{
    (void)state;
    (void)frame;
    (void)runner;
    return 0;
}

#define STAGE(name_, ...)                                                                          \
    static const struct stage name_ = {.name = #name_, .options = &count_record, __VA_ARGS__}
STAGE(source, .next = next, .writes = PART_OBJECTS);
STAGE(turner, .step = turn, .reads = PART_OBJECTS, .writes = PART_OBJECTS);
STAGE(failing, .step = fail_at_second, .reads = PART_OBJECTS);
STAGE(stopping, .step = pass, .reads = PART_OBJECTS, .stop = fail_at_stop);

struct stages {
    const struct stage *list[4];
};

static int run(const void *with)
{
    const struct stages *row = with;
    struct runner runners[4];
    size_t count = 0;
    for (; count < 4 && row->list[count] != NULL; count++)
        runner_prepare(&runners[count], row->list[count], 0, NULL);
    int code = chain_run(runners, count);
    for (size_t i = 0; i < count; i++)
        runner_free(&runners[i]);
    return code;
}

static struct captured *chain(const struct stage *first, const struct stage *second,
                              const struct stage *third)
{
    static struct captured captured;
    capture(&captured, run, &(struct stages){.list = {first, second, third}});
    return &captured;
}

static int lines_of(const char *text)
{
    int lines = 0;
    for (; (text = strchr(text, '\n')) != NULL; text++)
        lines++;
    return lines;
}

TEST(every_frame_goes_through_all_stages)
{
    struct captured *captured = chain(&source, &turner, NULL);
    assert_int_equal(captured->code, 0);
    assert_string_equal(captured->err, "");
    const char *at = captured->out;
    for (int i = 0; i < 3; i++) {
        char begin[64];
        snprintf(begin, sizeof begin, "{\"version\":1,\"scene\":\"s\",\"frame\":%d,", i);
        assert_memory_equal(at, begin, strlen(begin));
        at = strstr(at, "\"yaw_rad\":0.5,");
        assert_non_null(at);
        at = strchr(at, '\n') + 1;
    }
    assert_string_equal(at, "");
}

TEST(frames_before_a_failure_go_out_and_the_message_names_the_frame)
{
    struct captured *captured = chain(&source, &failing, NULL);
    assert_int_equal(captured->code, DIAG_DATA);
    assert_string_equal(captured->err, "glint-failing: scene \"s\", frame 1: no more\n");
    assert_int_equal(lines_of(captured->out), 1);
}

/* Stages behind a failure see the end of the stream, those before it do not. */
TEST(the_code_is_that_of_the_rightmost_stage_that_fails)
{
    struct captured *captured = chain(&source, &failing, &stopping);
    assert_int_equal(captured->code, DIAG_CONFIG);
    assert_string_equal(captured->err, "glint-failing: scene \"s\", frame 1: no more\n"
                                       "glint-stopping: at the end\n");
    captured = chain(&source, &stopping, &failing);
    assert_int_equal(captured->code, DIAG_DATA);
    assert_string_equal(captured->err, "glint-failing: scene \"s\", frame 1: no more\n");
}

/* Runs the program of the stage with one word. */
static int run_main(const void *with)
{
    return chain_main(&turner, 2, (char *[]){(char[]){"glint-turner"}, strdup(with), NULL});
}

TEST(a_program_of_one_stage_prints_what_it_is_or_refuses)
{
    static struct captured captured;
    capture(&captured, run_main, "--version");
    assert_int_equal(captured.code, 0);
    assert_string_equal(captured.out, "glint-turner (glint) " GLINT_VERSION "\n");
    capture(&captured, run_main, "--frames");
    assert_int_equal(captured.code, DIAG_USAGE);
    assert_string_equal(captured.err, "glint-turner: unknown option --frames; see --help\n");
    capture(&captured, run_main, "-");
    assert_int_equal(captured.code, 0);
    assert_string_equal(captured.out, "");
}
