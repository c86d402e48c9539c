#define SCRATCH_FILE "frames"
#include "scratch.h"

#include "run/chain.h"
#include "text/document.h"

/* What the tools of this file do: write two outputs, and frames between them. */
struct work {
    const char *folder;
    const char *second; /* the name of the second output */
    bool fail, silent;
    int64_t frames;
};

static const struct field work_fields[] = {
    {FIELD_NAME_OF(struct work, folder, "the folder of the outputs")},
    {FIELD_NAME_OF(struct work, second, "the name of the second output"), FIELD_OPTIONAL},
    {FIELD_FLAG_OF(struct work, fail, "fail after writing"), FIELD_OPTIONAL},
    {FIELD_FLAG_OF(struct work, silent, "fail without a message"), FIELD_OPTIONAL},
    {0}};
static const struct record work_record = {
    .name = "work", .size = sizeof(struct work), .fields = work_fields};

static int write_both(void *state, struct runner *runner)
{
    struct work *work = state;
    struct diag *diag = runner_diag(runner);
    struct output *first = runner_output_in(runner, work->folder, "first");
    struct output *second =
        runner_output_in(runner, work->folder, work->second != NULL ? work->second : "second");
    if (first == NULL || second == NULL || output_write(first, "one\n", 4, diag) != 0 ||
        output_write(second, "two\n", 4, diag) != 0)
        return -1;
    if (work->silent)
        return -1;
    return work->fail ? diag_fail(diag, DIAG_DATA, "as it was told to") : 0;
}

static int count_frames(void *state, struct runner *runner)
{
    struct work *work = state;
    struct output *output = runner_output_in(runner, work->folder, "first");
    struct frame *frame;
    int more;
    while ((more = runner_frame(runner, &frame)) > 0)
        work->frames += frame->seed == 7;
    char count = (char)('0' + work->frames);
    return more == 0 ? output_write(output, &count, 1, runner_diag(runner)) : -1;
}

static const struct stage writer = {.name = "writer",
                                    .summary = "Write two files.",
                                    .options = &work_record,
                                    .operand = "DIR",
                                    .into_folder = true,
                                    .run = write_both};
static const struct stage counter = {.name = "counter",
                                     .summary = "Count frames of seed 7.",
                                     .options = &work_record,
                                     .operand = "DIR",
                                     .into_folder = true,
                                     .draws = true,
                                     .reads = PART_OBJECTS,
                                     .run = count_frames};

#define HEAD(number, seed)                                                                         \
    "{\"version\":1,\"scene\":\"a\",\"frame\":" number ",\"time_s\":" number                       \
    ",\"interval_s\":1,\"seed\":\"" seed "\",\"ego\":\"e\""
#define OBJECTS                                                                                    \
    ",\"objects\":[{\"id\":\"e\",\"class\":\"car\",\"x_m\":0,\"y_m\":0,\"yaw_rad\":0,\"vx_mps\":"  \
    "0,"                                                                                           \
    "\"vy_mps\":0,\"yaw_rate_radps\":0,\"length_m\":0,\"width_m\":0,\"height_m\":0,"               \
    "\"travelled_m\":0}]}\n"
#define FRAME(number, seed) HEAD(number, seed) OBJECTS

/* The scratch with an old output and two frames. */
static int make_folder(void **state)
{
    make_scratch(state);
    scratch_write(scratch_in(*state, "first"), "old");
    scratch_write(scratch_in(*state, "frames"), FRAME("0", "7") FRAME("1", "8"));
    return 0;
}

/* The exit code of the tool; its words are the folder's name and those given, NULL after the last.
 */
static int run(const struct stage *tool, struct scratch *scratch, const char *const *more)
{
    const char *words[8] = {scratch->directory};
    size_t count = 1;
    for (; more[count - 1] != NULL; count++)
        words[count] = more[count - 1];
    struct runner runner;
    assert_int_equal(runner_prepare(&runner, tool, count, words), 0);
    int code = chain_run(&runner, 1);
    runner_free(&runner);
    return code;
}

static void assert_holds(struct scratch *scratch, const char *name, const char *expected)
{
    struct text *text = check_text();
    assert_done(document_bytes, scratch_in(scratch, name), text);
    text_add(text, "", 1);
    assert_string_equal(text->bytes, expected);
}

#define TOOL_TEST(name) TEST_WITH(make_folder, remove_scratch, struct scratch *scratch, name)

TOOL_TEST(every_output_takes_its_name_when_all_went_well)
{
    assert_int_equal(run(&writer, scratch, (const char *[]){NULL}), 0);
    assert_holds(scratch, "first", "one\n");
    assert_holds(scratch, "second", "two\n");
    assert_int_equal(scratch_count(scratch), 3);
}

TOOL_TEST(no_output_takes_its_name_if_the_tool_fails)
{
    assert_int_equal(run(&writer, scratch, (const char *[]){"--fail", NULL}), DIAG_DATA);
    assert_holds(scratch, "first", "old");
    assert_int_equal(scratch_count(scratch), 2);
}

/* The first is whole by then, and on the disk. */
TOOL_TEST(no_output_takes_its_name_if_another_cannot_be_written)
{
    assert_int_equal(symlink("/dev/full", scratch_in(scratch, "second")), 0);
    assert_int_equal(run(&writer, scratch, (const char *[]){NULL}), DIAG_IO);
    assert_holds(scratch, "first", "old");
    assert_int_equal(scratch_count(scratch), 3);
}

TOOL_TEST(an_output_that_cannot_be_made_fails_the_tool)
{
    assert_int_equal(run(&writer, scratch, (const char *[]){"--second", "nowhere/a", NULL}),
                     DIAG_CANNOT_CREATE);
    assert_holds(scratch, "first", "old");
    assert_int_equal(scratch_count(scratch), 2);
}

TOOL_TEST(a_tool_that_fails_without_a_word_is_told_of)
{
    assert_int_equal(run(&writer, scratch, (const char *[]){"--silent", NULL}), DIAG_INTERNAL);
}

TOOL_TEST(a_tool_gets_every_frame_with_the_seed_that_is_given)
{
    assert_int_equal(run(&counter, scratch, (const char *[]){scratch->path, NULL}), 0);
    assert_holds(scratch, "first", "1");
    assert_int_equal(run(&counter, scratch, (const char *[]){"--seed", "7", scratch->path, NULL}),
                     0);
    assert_holds(scratch, "first", "2");
}

TOOL_TEST(a_tool_gets_no_frame_without_what_it_reads)
{
    scratch_write(scratch->path, FRAME("0", "7") HEAD("1", "7") "}\n");
    assert_int_equal(run(&counter, scratch, (const char *[]){scratch->path, NULL}), DIAG_DATA);
    assert_holds(scratch, "first", "old");
}

TOOL_TEST(a_tool_fails_at_the_end_of_scenes_that_should_be_whole)
{
    assert_int_equal(run(&counter, scratch, (const char *[]){"--complete", scratch->path, NULL}),
                     DIAG_DATA);
    assert_holds(scratch, "first", "old");
}
