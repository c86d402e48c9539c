#include "scratch.h"

#include <sys/stat.h>

#include "captured.h"
#include "effects/effect.h"
#include "run/pipeline_process.h"
#include "run/stage.h"

/* Runs glint with these words, up to NULL. */
static int run_glint(const void *with)
{
    const char *const *words = with;
    char *copies[8] = {(char[]){"glint"}};
    int count = 1;
    for (; words[count - 1] != NULL; count++)
        copies[count] = strdup(words[count - 1]);
    return pipeline_process_main(count, copies);
}

static struct captured *glint(const char *option, const char *value)
{
    static struct captured captured;
    capture(&captured, run_glint, (const char *[]){option, value, NULL});
    return &captured;
}

static void expect_refused(const char *pipeline, int code, const char *message)
{
    struct captured *captured = glint("-c", pipeline);
    assert_int_equal(captured->code, code);
    assert_string_equal(captured->err, message);
    assert_string_equal(captured->out, "");
}

TEST(a_pipeline_runs_in_one_process)
{
    struct captured *captured =
        glint("-c", "set -o pipefail\nglint-traffic-random --frames 3 | glint-extract # twice\n");
    assert_int_equal(captured->code, 0);
    assert_string_equal(captured->err, "");
    size_t lines = 0;
    for (const char *at = captured->out; (at = strchr(at, '\n')) != NULL; at++)
        lines++;
    assert_int_equal(lines, 3);
    assert_non_null(strstr(captured->out, "\"reflectors\":"));
}

TEST(programs_out_of_place_are_refused)
{
    static const char *const cases[][2] = {
        {"glint-extract | glint-traffic a.json",
         "glint: -c:1: glint-traffic is a source and can only stand first; run it with bash\n"},
        {"glint-extract |\n glint-schema folder", "glint: -c:2: glint-schema reads no frames, so "
                                                  "it can only stand first; run it with bash\n"},
        {"glint-extract | glint-noise list.jsonl",
         "glint: -c:1: glint-noise reads files, so it can only stand first; run it with bash\n"},
        {"glint-plan --sensors a | glint-noise",
         "glint: -c:1: glint-plan writes no frames, so it can only stand last; run it with bash\n"},
        {"glint-view | glint-noise", "glint: -c:1: glint-view writes no frames, so it can only "
                                     "stand last; run it with bash\n"},
        {"glint-extract -o a | glint-noise",
         "glint: -c:1: glint-extract writes to a file, so it can "
         "only stand last; run it with bash\n"},
        {"glint-extract --help",
         "glint: -c:1: glint-extract was asked for --help or --version; run it with bash\n"},
        {"glint-nois", "glint: -c:1: glint-nois is no stage or tool of this build (did you mean "
                       "glint-noise?); run it with bash\n"},
        {"./glint-noise", "glint: -c:1: ./glint-noise is no stage or tool of this build (did you "
                          "mean glint-noise?); run it with bash\n"},
    };
    for (size_t i = 0; i < COUNT(cases); i++)
        expect_refused(cases[i][0], 64, cases[i][1]);
}

/* As bash does it under pipefail. */
TEST(the_exit_code_is_that_of_the_rightmost_program_that_fails)
{
    assert_int_equal(glint("-c", "glint-traffic nowhere | glint-extract")->code, 78);
    assert_int_equal(glint("-c", "glint-traffic nowhere | glint-noise --sensor 3")->code, 64);
}

TEST(what_glint_does_not_know_is_refused_with_what_it_does)
{
    assert_int_equal(glint("--lisst", "stages")->code, 64);
    assert_string_equal(glint("--lisst", "stages")->err,
                        "glint: unknown option --lisst (did you mean --list?); see --help\n");
    assert_string_equal(glint("-c", NULL)->err,
                        "glint: expected a FILE, -c TEXT or an option; see --help\n");
    assert_int_equal(glint("no-such-pipeline", NULL)->code, 78);
    assert_int_equal(glint("--help", NULL)->code, 0);
    assert_memory_equal(glint("--help", NULL)->out, "Usage: glint FILE\n", 18);
}

/* The lines of that kind. */
static const char *listed(const char *kind)
{
    struct captured *captured = glint("--list", kind);
    if (captured->code != 0)
        fail_msg("%s", captured->err);
    return captured->out;
}

static void expect_line(const char *kind, const char *line, bool expected)
{
    const char *text = listed(kind), *at = strstr(text, line);
    bool found = at != NULL && (at == text || at[-1] == '\n');
    if (found != expected)
        fail_msg("\"%s\" is %sin:\n%s", line, expected ? "not " : "", text);
}

TEST(stages_and_tools_have_a_line_each_with_their_sentence)
{
    char line[512];
    for (size_t i = 0; stages[i] != NULL; i++) {
        snprintf(line, sizeof line, "glint-%-17s  %s  %s\n", stages[i]->name,
                 stages[i]->run != NULL ? "tool " : "stage", stages[i]->summary);
        expect_line("programs", line, true);
    }
}

TEST(an_effect_is_listed_by_its_name_and_with_the_others)
{
    char line[512];
    for (int i = 0; i < EFFECT_COUNT; i++) {
        const struct effect *effect = effect_table[i];
        snprintf(line, sizeof line, "%-16s  %-7s %s\n", effects_names[i],
                 effect_homes[effect->home], effect->summary);
        expect_line("effects", line, true);
        snprintf(line, sizeof line, "described by %s\n", effect->cause);
        expect_line(effects_names[i], line, true);
        expect_line(effects_names[i], "auto never leaves it out\n", effect->left_out_when == NULL);
        expect_line(effects_names[i], "auto leaves it out when ", effect->left_out_when != NULL);
    }
    expect_line("rain", "simulated by glint-sensor\n", true);
}

TEST(documents_tell_what_they_are)
{
    expect_line("vehicles", "car                    4.5 m long, 1.8 m wide, 1.5 m high; also ",
                true);
    expect_line("vehicles", "wall                   10 m long, 0.2 m wide, 2.5 m high\n", true);
    expect_line("scenarios", "cut-in                 ", true);
    const char *sensors = listed("sensors");
    assert_null(strstr(sensors, "Made for glint"));
    assert_null(strstr(sensors, "without an origin"));
}

SCRATCH_TEST(documents_of_the_user_are_listed_also_if_they_cannot_be_read)
{
    assert_int_equal(setenv("GLINT_DATA", scratch->directory, 1), 0);
    assert_int_equal(mkdir(scratch_in(scratch, "vehicles"), 0700), 0);
    assert_int_equal(mkdir(scratch_in(scratch, "pipelines"), 0700), 0);
    scratch_write(scratch_in(scratch, "vehicles/broken.json"), "{}");
    scratch_write(scratch_in(scratch, "pipelines/mine.sh"),
                  "#!/bin/sh\n# A title. What it shows, and\n# how. More.\n\n# Less.\n");
    expect_line("pipelines", "mine                   A title. What it shows, and how.\n", true);
    expect_line("vehicles", "broken                 ", true);
    assert_non_null(strstr(listed("vehicles"), "missing; expected"));
    unsetenv("GLINT_DATA");
}

TEST(an_unknown_kind_is_refused_with_what_was_meant)
{
    struct captured *captured = glint("--list", "sensor");
    assert_int_equal(captured->code, DIAG_USAGE);
    assert_string_equal(
        captured->err,
        "glint: --list sensor is unknown (did you mean sensors?); expected programs, "
        "effects, sections, sensors, scenarios, vehicles, pipelines or the name of an effect\n");
    assert_string_equal(captured->out, "");
}
