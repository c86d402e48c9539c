#include "check.h"

#include "run/options.h"
#include "run/stage.h"
#include "run/tool.h"

struct choice {
    const char *where;
    double radius_m;
    int64_t number;
    bool quick;
    int mode;
};

static const char *const modes[] = {"slow", "fast", NULL};

static const struct field fields[] = {
    {FIELD_NAME_OF(struct choice, where, "the place")},
    {FIELD_REAL_IN(struct choice, radius_m, -5, 100, "how far"), FIELD_OPTIONAL, .absent = 7},
    {FIELD_INTEGER_IN(struct choice, number, 0, 9, "how many"), FIELD_OPTIONAL},
    {FIELD_FLAG_OF(struct choice, quick, "hurry"), FIELD_OPTIONAL},
    {FIELD_CHOICE_OF(struct choice, mode, modes, "which way"), FIELD_OPTIONAL},
    {0}};
static const struct record choices = {
    .name = "stage", .size = sizeof(struct choice), .fields = fields};

static int no_frame(void *state, struct frame *frame, struct runner *runner)
{
    (void)state, (void)frame, (void)runner;
    return 0;
}

static const struct stage filter = {.name = "filter",
                                    .summary = "Filter.",
                                    .options = &choices,
                                    .reads = PART_ECHOES,
                                    .writes = PART_CELLS,
                                    .step = no_frame};
static const struct stage source = {.name = "source",
                                    .summary = "Make.",
                                    .options = &choices,
                                    .operand = "PLACE",
                                    .writes = PART_OBJECTS,
                                    .next = no_frame};

static int no_work(void *state, struct runner *runner)
{
    (void)state, (void)runner;
    return 0;
}

/* A tool that reads frames and writes to --output, and one that writes files into a folder. */
static const struct stage reader = {.name = "reader",
                                    .summary = "Read.",
                                    .options = &choices,
                                    .reads = PART_TARGETS,
                                    .run = no_work};
static const struct stage tables = {.name = "tables",
                                    .summary = "Tabulate.",
                                    .options = &choices,
                                    .operand = "DIR",
                                    .into_folder = true,
                                    .reads = PART_TARGETS,
                                    .run = no_work};
static const struct stage maker = {.name = "maker",
                                   .summary = "Write.",
                                   .options = &choices,
                                   .operand = "DIR",
                                   .into_folder = true,
                                   .run = no_work};

struct result {
    struct choice choice;
    struct common_options common;
    struct diag diag;
};

/* The words are parted by single blanks. */
static int read_line(const struct stage *stage, const char *line, struct result *result)
{
    const char *words[32];
    size_t count = 0;
    *result = (struct result){0};
    for (const char *at = line; *at != '\0'; at += strspn(at, " ")) {
        size_t length = strcspn(at, " ");
        assert_true(count < COUNT(words));
        words[count++] = arena_text(check_arena(), at, length);
        at += length;
    }
    return options_read(stage, count, words, &result->choice, &result->common, check_arena(),
                        &result->diag);
}

TEST(options_come_in_any_order_and_both_spellings)
{
    static const char *const lines[] = {
        "--where here --radius-m 50 --number 3 --quick --mode fast -o out --seed 5 --sections none "
        "a b",
        "a --mode=fast --quick --number=3 --radius-m=5e1 --where=here --output=out --seed=5 b "
        "--sections=none",
        "--sections all --sections none --radius-m 1 --radius-m 50 --quick --where x --where here "
        "--number 3 --mode fast "
        "--output out --seed 5 -- a b"};
    for (size_t i = 0; i < COUNT(lines); i++) {
        struct result result;
        if (read_line(&filter, lines[i], &result) != 0)
            fail_msg("%s: %s", lines[i], result.diag.text);
        assert_string_equal(result.choice.where, "here");
        assert_close(result.choice.radius_m, 50, 0);
        assert_int_equal(result.choice.number, 3);
        assert_true(result.choice.quick && !result.common.complete);
        assert_int_equal(result.choice.mode, 1);
        assert_string_equal(result.common.output, "out");
        assert_int_equal(result.common.seed, 5);
        assert_int_equal(result.common.files.count, 2);
        assert_string_equal(result.common.files.items[1], "b");
    }
}

TEST(what_is_not_given_is_absent)
{
    struct result result;
    assert_int_equal(read_line(&filter, "--where x", &result), 0);
    assert_close(result.choice.radius_m, 7, 0);
    assert_false(result.choice.quick || result.common.sections != NULL || result.common.help);
    assert_null(result.common.output);
    assert_false(result.common.seed_given);
    assert_int_equal(result.common.seed, 1);
    assert_int_equal(result.common.files.count, 0);
}

TEST(values_and_files_may_begin_with_a_dash)
{
    struct result result;
    assert_int_equal(read_line(&filter, "--radius-m -5 --where -x - -- --where -", &result), 0);
    assert_close(result.choice.radius_m, -5, 0);
    assert_string_equal(result.choice.where, "-x");
    assert_int_equal(result.common.files.count, 3);
    assert_string_equal(result.common.files.items[0], "-");
    assert_string_equal(result.common.files.items[1], "--where");
    assert_int_equal(read_line(&source, "--seed 18446744073709551615 here", &result), 0);
    assert_string_equal(result.choice.where, "here");
    assert_true(result.common.seed == UINT64_MAX);
}

TEST(help_and_version_need_nothing_else)
{
    struct result result;
    assert_int_equal(read_line(&filter, "--help", &result), 0);
    assert_true(result.common.help);
    assert_int_equal(read_line(&source, "--version", &result), 0);
    assert_true(result.common.version);
}

/* Of tools also options that would do nothing. */
TEST(wrong_command_lines_are_refused)
{
    static const struct {
        const struct stage *stage;
        const char *line, *message;
    } cases[] = {
        {&filter, "", "missing --where: the place; see --help"},
        {&source, "", "missing PLACE: the place; see --help"},
        {&source, "a b", "one argument too many: b"},
        {&source, "a -x", "unknown option -x; see --help"},
        {&source, "a --where b", "unknown option --where; see --help"},
        {&source, "a --complete", "unknown option --complete; see --help"},
        {&filter, "--wher x", "unknown option --wher (did you mean --where?); see --help"},
        {&filter, "--where_ x", "unknown option --where_ (did you mean --where?); see --help"},
        {&filter, "--seed-text 1", "unknown option --seed-text; see --help"},
        {&filter, "--files 1", "unknown option --files; see --help"},
        {&filter, "--=1", "unknown option --=1; see --help"},
        {&filter, "--where", "--where needs a value"},
        {&filter, "--where x -o", "-o needs a value"},
        {&filter, "--quick=yes", "--quick takes no value"},
        {&filter, "--where=", "--where: a name of 0 bytes; expected 1 to 1024"},
        {&filter, "--number 1.5", "--number: 1.5 is not a whole number"},
        {&filter, "--number 10", "--number: 10 is outside [0, 9]"},
        {&filter, "--number ten", "--number: ten; expected a whole number in [0, 9]"},
        {&filter, "--number nan", "--number: nan; expected a whole number in [0, 9]"},
        {&filter, "--number 0x1", "--number: 0x1; expected a whole number in [0, 9]"},
        {&filter, "--number=", "--number: ; expected a whole number in [0, 9]"},
        {&filter, "--radius-m 101", "--radius-m: 101 is outside [-5, 100] m"},
        {&filter, "--mode up", "--mode: \"up\" is unknown; expected one of slow, fast"},
        {&filter, "--seed -1",
         "--seed: \"-1\" is no seed; expected decimal digits up to 18446744073709551615"},
        {&maker, "", "missing DIR: the place; see --help"},
        {&maker, "a b", "one argument too many: b"},
        {&maker, "a -o x", "unknown option -o; see --help"},
        {&maker, "a --seed 1", "unknown option --seed; see --help"},
        {&maker, "a --complete", "unknown option --complete; see --help"},
        {&tables, "a -o x", "unknown option -o; see --help"},
        {&tables, "a --sections all", "unknown option --sections; see --help"},
        {&reader, "--where x --sections all", "unknown option --sections; see --help"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct result result;
        assert_int_equal(read_line(cases[i].stage, cases[i].line, &result), -1);
        assert_string_equal(result.diag.text, cases[i].message);
        assert_int_equal(result.diag.code, DIAG_USAGE);
    }
}

TEST(a_tools_operand_comes_before_the_files_that_it_reads)
{
    struct result result;
    assert_int_equal(read_line(&tables, "folder a --complete b", &result), 0);
    assert_string_equal(result.choice.where, "folder");
    assert_int_equal(result.common.files.count, 2);
    assert_string_equal(result.common.files.items[0], "a");
    assert_true(result.common.complete);
    assert_int_equal(read_line(&reader, "--where x a -o out", &result), 0);
    assert_int_equal(result.common.files.count, 1);
    assert_string_equal(result.common.output, "out");
}

TEST(only_what_writes_frames_or_draws_takes_a_seed)
{
    struct result result;
    struct stage drawer = tables, sink = filter;
    drawer.draws = true;
    sink.sink = true;
    assert_int_equal(read_line(&drawer, "folder --seed 3", &result), 0);
    assert_true(result.common.seed_given && result.common.seed == 3);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(i == 0 ? read_line(&tables, "folder --seed 3", &result)
                                : read_line(&sink, "--where x --seed 3", &result),
                         -1);
        assert_string_equal(result.diag.text, "unknown option --seed; see --help");
    }
}

static void assert_helps(const struct stage *stage, const char *const *parts, size_t count)
{
    struct text *text = check_text();
    options_help(stage, text);
    text_add(text, "", 1);
    for (size_t i = 0; i < count; i++)
        if (strstr(text->bytes, parts[i]) == NULL)
            fail_msg("\"%s\" is not in:\n%s", parts[i], text->bytes);
}

TEST(help_names_every_option_with_unit_bounds_and_choices)
{
    static const char *const of_filter[] = {"Usage: glint-filter [OPTION]... [FILE]...\nFilter.\n",
                                            "input; parts: echoes.\n",
                                            "output; parts: cells.\n",
                                            "      --where=NAME ",
                                            "      --radius-m=NUMBER ",
                                            "how far; a number in [-5, 100] m\n",
                                            "how many; a whole number in [0, 9]\n",
                                            "      --quick ",
                                            "which way; one of slow, fast\n",
                                            "  -o, --output=FILE ",
                                            "      --sections=LIST ",
                                            "      --complete ",
                                            "      --seed=SEED ",
                                            "  -h, --help ",
                                            "      --version ",
                                            "\nExit status: 0"};
    static const char *const of_source[] = {"Usage: glint-source [OPTION]... PLACE\nMake.\n",
                                            "\nPLACE: the place.\n", "parts: objects.\n"};
    static const char *const of_tables[] = {
        "Usage: glint-tables [OPTION]... DIR [FILE]...\nTabulate.\n", "\nDIR: the place.\n",
        "parts: targets.\n"};
    static const char *const of_maker[] = {"Usage: glint-maker [OPTION]... DIR\nWrite.\n"};
    assert_helps(&filter, of_filter, COUNT(of_filter));
    assert_helps(&source, of_source, COUNT(of_source));
    assert_helps(&tables, of_tables, COUNT(of_tables));
    assert_helps(&maker, of_maker, COUNT(of_maker));
    struct text *text = check_text();
    options_help(&source, text);
    text_add(text, "", 1);
    assert_null(strstr(text->bytes, "--complete"));
    assert_null(strstr(text->bytes, "--where"));
}
