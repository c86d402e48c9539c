#include "check.h"

#include "run/stage.h"

TEST(a_program_has_the_name_behind_glint)
{
    assert_string_equal(stage_name_in_path("glint-plan"), "plan");
    assert_string_equal(stage_name_in_path("/usr/bin/glint-sensor-signal"), "sensor-signal");
    assert_null(stage_name_in_path("glint"));
    assert_null(stage_name_in_path("/glint-plan/other"));
}

TEST(every_stage_and_every_tool_is_found_by_its_name_alone)
{
    for (size_t i = 0; stages[i] != NULL; i++) {
        assert_ptr_equal(stage_by_name(stages[i]->name), stages[i]);
        for (size_t j = 0; j < i; j++)
            assert_string_not_equal(stages[i]->name, stages[j]->name);
    }
    assert_null(stage_by_name("sens"));
    assert_null(stage_by_name(""));
}

static int next(void *state, struct frame *frame, struct runner *runner)
{
    (void)state;
    (void)frame;
    (void)runner;
    return 0;
}

TEST(a_stage_is_a_source_a_filter_or_a_sink)
{
    static const struct {
        struct stage stage;
        enum stage_kind kind;
        bool takes_files;
    } cases[] = {
        {{.name = "source", .next = next, .writes = 1}, STAGE_SOURCE, false},
        {{.name = "filter", .step = next, .reads = 2, .writes = 4}, STAGE_FILTER, true},
        {{.name = "sink", .step = next, .reads = 2, .sink = true}, STAGE_SINK, true},
    };
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(stage_kind(&cases[i].stage), cases[i].kind);
        assert_int_equal(stage_takes_files(&cases[i].stage), cases[i].takes_files);
    }
}

TEST(a_tool_takes_files_of_frames_only_if_it_reads_any)
{
    assert_int_equal(stage_kind(stage_by_name("plan")), STAGE_TOOL);
    assert_int_equal(stage_kind(stage_by_name("schema")), STAGE_TOOL);
    assert_true(stage_takes_files(stage_by_name("plan")));
    assert_false(stage_takes_files(stage_by_name("schema")));
}
