#define SCRATCH_FILE "told"
#include "scratch.h"

#include "effects/effect.h"
#include "run/explain.h"
#include "run/options.h"

/* The file's content, with a NUL at the end. */
static const char *content(const struct scratch *scratch)
{
    static char bytes[1 << 14];
    FILE *file = fopen(scratch->path, "r");
    assert_non_null(file);
    bytes[fread(bytes, 1, sizeof bytes - 1, file)] = '\0';
    fclose(file);
    return bytes;
}

static struct effect_log sample_log(void)
{
    struct effect_log log = {.scans = 4};
    log.scans_simulated[EFFECT_MERGING] = 3;
    log.scans_left_out[EFFECT_MERGING] = 1;
    log.spent_ns[EFFECT_MERGING] = 8000;
    return log;
}

static void a_log_begins_empty_and_has_a_clock_that_goes_forward(void **state)
{
    struct scratch *scratch = *state;
    struct effect_log *log = explain_begin(&scratch->arena);
    assert_int_equal(log->scans, 0);
    int64_t before = log->clock_ns();
    assert_true(before > 0 && log->clock_ns() >= before);
}

static void a_stage_has_a_line_for_each_effect_that_is_at_home_there(void **state)
{
    struct scratch *scratch = *state;
    struct effect_log log = sample_log();
    struct diag diag = {0};
    struct common_options common = {.explain = scratch->path};
    assert_int_equal(explain_append(&common, "sensor-smear", &log, &diag), 0);
    const char *told = content(scratch);
    for (int i = 0; i < EFFECT_COUNT; i++) {
        char part[96];
        snprintf(part, sizeof part, "{\"stage\":\"sensor-smear\",\"effect\":\"%s\",",
                 effects_names[i]);
        bool at_home = strcmp(effect_homes[effect_table[i]->home], "sensor") == 0;
        assert_int_equal(strstr(told, part) != NULL, at_home);
    }
    assert_non_null(strstr(told,
                           "\"effect\":\"merging\",\"scans\":4,\"simulated\":3,\"left_out\":1,"
                           "\"ns\":8000,\"left_out_when\":\""));
    assert_non_null(strstr(told, "\"effect\":\"threshold\",\"scans\":4,\"simulated\":0,\"left_out\""
                                 ":0,\"ns\":null,\"left_out_when\":null}\n"));
}

static void stages_share_a_file_and_a_table_is_for_people(void **state)
{
    struct scratch *scratch = *state;
    struct effect_log log = sample_log();
    struct diag diag = {0};
    struct common_options common = {.explain = scratch->path, .text = true};
    assert_int_equal(explain_check(scratch->path, &diag), 0);
    assert_string_equal(content(scratch), "");
    assert_int_equal(explain_append(&common, "sensor", &log, &diag), 0);
    size_t length = strlen(content(scratch));
    assert_int_equal(explain_append(&common, "noise", &log, &diag), 0);
    const char *told = content(scratch);
    assert_non_null(strstr(told, "\nmerging                    3          1       2.00  "));
    assert_non_null(strstr(told, "\nthreshold                  0          0          -  -\n"));
    assert_memory_equal(told, "sensor             simulated   left out  us a scan  left out when\n",
                        66);
    assert_memory_equal(told + length, "noise              simulated ", 29);
}

static void a_file_that_cannot_be_written_is_refused(void **state)
{
    (void)state;
    struct diag diag = {0};
    struct effect_log log = {0};
    assert_int_equal(explain_check("/nonexistent/told", &diag), -1);
    assert_int_equal(diag.code, DIAG_CANNOT_CREATE);
    assert_string_equal(diag.text, "/nonexistent/told: No such file or directory");
    diag = (struct diag){0};
    assert_int_equal(
        explain_append(&(struct common_options){.explain = "/dev/full"}, "noise", &log, &diag), -1);
    assert_int_equal(diag.code, DIAG_IO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#define TEST(function) cmocka_unit_test_setup_teardown(function, make_scratch, remove_scratch)
        TEST(a_log_begins_empty_and_has_a_clock_that_goes_forward),
        TEST(a_stage_has_a_line_for_each_effect_that_is_at_home_there),
        TEST(stages_share_a_file_and_a_table_is_for_people),
        TEST(a_file_that_cannot_be_written_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
