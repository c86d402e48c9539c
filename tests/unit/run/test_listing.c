#define SCRATCH_FILE "broken.json"
#include "scratch.h"

#include <sys/stat.h>

#include "effects/effect.h"
#include "run/fused.h"
#include "run/listing.h"

/* The lines of that kind, with a NUL at the end. The caller frees them. */
static struct text listed(const char *kind)
{
    struct text text = {0};
    struct arena arena = {0};
    struct diag diag = {0};
    if (listing_add(kind, &text, &arena, &diag) != 0)
        fail_msg("%s", diag.text);
    text_add(&text, "", 1);
    arena_free(&arena);
    return text;
}

static void expect_line(const char *kind, const char *line, bool expected)
{
    struct text text = listed(kind);
    const char *at = strstr(text.bytes, line);
    bool found = at != NULL && (at == text.bytes || at[-1] == '\n');
    if (found != expected)
        fail_msg("\"%s\" is %sin:\n%s", line, expected ? "not " : "", text.bytes);
    text_free(&text);
}

static void stages_and_tools_have_a_line_each_with_their_sentence(void **state)
{
    (void)state;
    char line[512];
    for (size_t i = 0; stages[i] != NULL; i++) {
        snprintf(line, sizeof line, "glint-%-18s %s\n", stages[i]->name, stages[i]->summary);
        expect_line("stages", line, true);
        expect_line("tools", line, false);
    }
    for (size_t i = 0; tools[i] != NULL; i++) {
        snprintf(line, sizeof line, "glint-%-18s %s\n", tools[i]->name, tools[i]->summary);
        expect_line("tools", line, true);
        expect_line("stages", line, false);
    }
}

static void an_effect_is_listed_by_its_name_and_with_the_others(void **state)
{
    (void)state;
    char line[512];
    for (int i = 0; i < EFFECT_COUNT; i++) {
        const struct effect *effect = effect_table[i];
        snprintf(line, sizeof line, "%-17s %-7s %s\n", effects_names[i], effect_homes[effect->home],
                 effect->summary);
        expect_line("effects", line, true);
        snprintf(line, sizeof line, "described by %s\n", effect->cause);
        expect_line(effects_names[i], line, true);
        expect_line(effects_names[i], "auto never leaves it out\n", effect->left_out_when == NULL);
        expect_line(effects_names[i], "auto leaves it out when ", effect->left_out_when != NULL);
    }
    expect_line("rain", "simulated by glint-sensor\n", true);
}

static void documents_tell_what_they_are(void **state)
{
    (void)state;
    expect_line("vehicles", "car                    4.5 m long, 1.8 m wide, 1.5 m high\n", true);
    expect_line("scenarios", "cut-in                 ", true);
    struct text sensors = listed("sensors");
    assert_null(strstr(sensors.bytes, "Made for glint"));
    assert_null(strstr(sensors.bytes, "without an origin"));
    text_free(&sensors);
}

/* Puts a document of the user's own into a folder of the scratch directory. */
static void write_document(const struct scratch *scratch, const char *kind, const char *name,
                           const char *content)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", scratch->directory, kind);
    assert_int_equal(mkdir(path, 0700), 0);
    snprintf(path, sizeof path, "%s/%s/%s", scratch->directory, kind, name);
    FILE *file = fopen(path, "w");
    assert_true(fputs(content, file) >= 0 && fclose(file) == 0);
}

static void remove_document(const struct scratch *scratch, const char *kind, const char *name)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s/%s", scratch->directory, kind, name);
    assert_int_equal(unlink(path), 0);
    snprintf(path, sizeof path, "%s/%s", scratch->directory, kind);
    assert_int_equal(rmdir(path), 0);
}

static void documents_of_the_user_are_listed_also_if_they_cannot_be_read(void **state)
{
    struct scratch *scratch = *state;
    assert_int_equal(setenv("GLINT_DATA", scratch->directory, 1), 0);
    write_document(scratch, "vehicles", "broken.json", "{}");
    write_document(scratch, "pipelines", "mine.sh",
                   "#!/bin/sh\n# A title. What it shows, and\n# how. More.\n\n# Less.\n");
    expect_line("pipelines", "mine                   A title. What it shows, and how.\n", true);
    expect_line("vehicles", "broken                 ", true);
    struct text text = listed("vehicles");
    assert_non_null(strstr(text.bytes, "missing; expected"));
    text_free(&text);
    unsetenv("GLINT_DATA");
    remove_document(scratch, "vehicles", "broken.json");
    remove_document(scratch, "pipelines", "mine.sh");
}

static void an_unknown_kind_is_refused_with_what_was_meant(void **state)
{
    (void)state;
    struct text text = {0};
    struct arena arena = {0};
    struct diag diag = {0};
    assert_int_equal(listing_add("sensor", &text, &arena, &diag), -1);
    assert_int_equal(diag.code, DIAG_USAGE);
    assert_string_equal(diag.text,
                        "--list sensor is unknown (did you mean sensors?); expected sensors, "
                        "scenarios, vehicles, pipelines, stages, tools, effects or the name of an "
                        "effect");
    assert_int_equal(text.length, 0);
    arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stages_and_tools_have_a_line_each_with_their_sentence),
        cmocka_unit_test(an_effect_is_listed_by_its_name_and_with_the_others),
        cmocka_unit_test(documents_tell_what_they_are),
        cmocka_unit_test_setup_teardown(
            documents_of_the_user_are_listed_also_if_they_cannot_be_read, make_scratch,
            remove_scratch),
        cmocka_unit_test(an_unknown_kind_is_refused_with_what_was_meant),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
