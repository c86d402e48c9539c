#include "check.h"

#include "run/program.h"
#include "run/stage.h"
#include "run/tool.h"

static int next(void *state, struct frame *frame, struct runner *runner)
{
    (void)state;
    (void)frame;
    (void)runner;
    return 0;
}

static void a_stage_is_a_source_a_filter_or_a_sink(void **state)
{
    (void)state;
    static const struct {
        struct stage stage;
        enum program_kind kind;
        bool takes_files;
    } cases[] = {
        {{.name = "source", .next = next, .writes = 1}, PROGRAM_SOURCE, false},
        {{.name = "filter", .step = next, .reads = 2, .writes = 4}, PROGRAM_FILTER, true},
        {{.name = "sink", .step = next, .reads = 2, .sink = true}, PROGRAM_SINK, true},
    };
    for (size_t i = 0; i < 3; i++) {
        struct program program = program_of_stage(&cases[i].stage);
        assert_int_equal(program.kind, cases[i].kind);
        assert_int_equal(program.takes_files, cases[i].takes_files);
        assert_int_equal(program.reads, cases[i].stage.reads);
        assert_int_equal(program.writes, cases[i].stage.writes);
        assert_false(program.into_folder);
        assert_ptr_equal(program.name, cases[i].stage.name);
    }
}

static void texts_options_and_operand_are_those_of_the_stage_and_the_tool(void **state)
{
    (void)state;
    static const struct stage stage = {.name = "a",
                                       .summary = "b",
                                       .details = "c",
                                       .options = &no_options_record,
                                       .operand = "FILE"};
    static const struct tool tool = {.name = "d",
                                     .summary = "e",
                                     .details = "f",
                                     .options = &no_options_record,
                                     .operand = "DIR"};
    struct program one = program_of_stage(&stage), other = program_of_tool(&tool);
    assert_string_equal(one.summary, "b");
    assert_string_equal(one.details, "c");
    assert_string_equal(one.operand, "FILE");
    assert_ptr_equal(one.options, &no_options_record);
    assert_string_equal(other.name, "d");
    assert_string_equal(other.summary, "e");
    assert_string_equal(other.details, "f");
    assert_string_equal(other.operand, "DIR");
    assert_ptr_equal(other.options, &no_options_record);
}

static void a_tool_takes_files_of_frames_only_if_it_reads_any(void **state)
{
    (void)state;
    for (unsigned reads = 0; reads < 2; reads++)
        for (int into_folder = 0; into_folder < 2; into_folder++) {
            struct program program =
                program_of_tool(&(struct tool){.reads = reads, .into_folder = into_folder != 0});
            assert_int_equal(program.kind, PROGRAM_TOOL);
            assert_int_equal(program.takes_files, reads != 0);
            assert_int_equal(program.reads, reads);
            assert_int_equal(program.into_folder, into_folder);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stage_is_a_source_a_filter_or_a_sink),
        cmocka_unit_test(texts_options_and_operand_are_those_of_the_stage_and_the_tool),
        cmocka_unit_test(a_tool_takes_files_of_frames_only_if_it_reads_any),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
