#include "check.h"

#include <unistd.h>

#include "base/text.h"
#include "run/pipeline.h"
#include "sample.h"

static int parse(const char *text, struct pipeline *pipeline, struct arena *arena,
                 struct diag *diag)
{
    *diag = (struct diag){0};
    return pipeline_parse(text, strlen(text), pipeline, arena, diag);
}

/* The commands as one text: words in <>, commands parted by |. */
static struct text *shown(const struct pipeline *pipeline)
{
    struct text *text = check_text();
    for (size_t i = 0; i < pipeline->commands.count; i++) {
        const struct command *command = &pipeline->commands.items[i];
        text_add_word(text, i > 0 ? "|" : "");
        for (size_t j = 0; j < command->words.count; j++)
            text_format(text, "<%s>", command->words.items[j]);
    }
    text_add(text, "", 1);
    return text;
}

TEST(words_and_bars_are_what_they_look_like)
{
    static const struct {
        const char *text, *commands;
    } cases[] = {
        {"a", "<a>"},
        {"a b  c\td", "<a><b><c><d>"},
        {"a|b", "<a>|<b>"},
        {"  a | b\n", "<a>|<b>"},
        {"a |\n\n  b -x 1 |\n c", "<a>|<b><-x><1>|<c>"},
        {"a \\\n  | b \\\n  -x", "<a>|<b><-x>"},
        {"#!/usr/bin/env bash\n# one\n\nset -o pipefail\n\na | # two | c\n  # three\nb # four\n\n",
         "<a>|<b>"},
        {"set -o pipefail\na", "<a>"},
        {"set \\\n -o 'pipefail' # why\na", "<a>"},
        {"a --origin='one two' \"three  'four'\"", "<a><--origin=one two><three  'four'>"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct pipeline pipeline;
        struct diag diag;
        if (parse(cases[i].text, &pipeline, check_arena(), &diag) != 0)
            fail_msg("%s: %s", cases[i].text, diag.text);
        struct text *text = shown(&pipeline);
        assert_string_equal(text->bytes, cases[i].commands);
    }
}

/* What bash makes of each text as one command's words: each followed by a newline, each text by a
 * line of its own. printf repeats its format for every word. */
static struct text *asked_of_bash(const struct text *script)
{
    char path[] = "/tmp/glint-pipeline-XXXXXX", command[64];
    int fd = mkstemp(path);
    assert_true(fd >= 0);
    assert_int_equal(write(fd, script->bytes, script->length), script->length);
    close(fd);
    snprintf(command, sizeof command, "bash %s 2>&1", path);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    struct text *answer = check_text();
    for (size_t got = 1; got > 0; answer->length += got)
        got = fread(text_room(answer, 4096), 1, 4096, pipe);
    pclose(pipe);
    unlink(path);
    return answer;
}

static void add_question(const char *words, struct text *script, struct text *expected)
{
    struct pipeline pipeline;
    struct diag diag;
    struct text *text = check_text();
    text_format(text, "p %s\n\n", words);
    if (pipeline_parse(text->bytes, text->length, &pipeline, check_arena(), &diag) == 0 &&
        pipeline.commands.count == 1) {
        text_format(script, "printf '%%s\\n' - %.*secho = end\n", (int)text->length - 2,
                    text->bytes + 2);
        const struct command *command = pipeline.commands.items;
        text_add_word(expected, "-\n");
        for (size_t i = 1; i < command->words.count; i++)
            text_format(expected, "%s\n", command->words.items[i]);
        text_add_word(expected, "= end\n");
    }
}

TEST(bash_sees_the_same_words)
{
    /* parted by semicolons */
    static const char words[] =
        "a b c;'a b' \"c d\";a'b'\"c\"d;'';\"\";'' \"\" ''\"\";a\\ b;\\a\\b\\\\;\\'\\\";"
        "'\\a\\\\';\"\\a \\\\ \\\" \\` \\$ \\' \\n\";'\"' \"'\";a#b;a #b;''#b;a\\#b;\\#b;"
        "'#'b;a \\\n b;a\\\nb;\\\n#b;a\\\n#b;'a\nb';\"a\nb\";\"a\\\nb\";'a\\\nb';a=b;--x=y z;"
        "-- -x;%s %d;a\\|b;'|' \"|\";\\~;a~b;~\\\n;'~';\\*;'*?[';a]b;a,b;a^b;a%b @c +d;a:b;"
        "\xc3\xa9 \xe2\x82\xac;'\xc3\xa9';a\\\tb;a\tb;a\vb a\fb;a\rb;\\\\;a\\;\"a\"\\\n\"b\";"
        "\\\n;\\\n\\\na;a\\\n\n;\\ ;' ';-x1 -y=-2.5e3;\"\\\\\"\\\\'\\\\';a\xc2\xa0-;\"!\";"
        "'!';\\!;\"\\!\";\"*\";\"~\";a\\=b;\\{a,b\\};'{a,b}';\"{a,b}\";/a/~ ./~;--file=~/x;"
        "a'#'b#c;";
    struct text *script = check_text(), *expected = check_text();
    for (const char *at = words; *at != '\0'; at += strcspn(at, ";") + 1)
        add_question(arena_text(check_arena(), at, strcspn(at, ";")), script, expected);
    struct text *answer = asked_of_bash(script);
    text_add(answer, "", 1);
    text_add(expected, "", 1);
    assert_string_equal(answer->bytes, expected->bytes);
}

/* Random texts of the characters that mean something: whatever is not refused, bash reads alike. */
TEST(bash_sees_the_same_words_in_random_texts)
{
    static const char *const pieces[] = {"a",  "b",  "'", "'", "\"", "\"",  "\\",
                                         "\\", "\n", " ", " ", "#",  "\t",  "\\\n",
                                         "$",  "x=", "%", "]", "-",  "\\\""};
    uint64_t random = 8;
    struct text *script = check_text(), *expected = check_text();
    for (int i = 0; i < 20000; i++) {
        struct text *text = check_text();
        for (uint64_t count = 1 + sample_bits(&random) % 8; count > 0; count--)
            text_add_word(text, pieces[sample_bits(&random) % COUNT(pieces)]);
        text_add(text, "", 1);
        add_question(text->bytes, script, expected);
    }
    assert_true(expected->length > 50000);
    struct text *answer = asked_of_bash(script);
    const char *a = answer->bytes, *b = expected->bytes;
    size_t same = 0;
    while (same < answer->length && same < expected->length && a[same] == b[same])
        same++;
    if (same < answer->length || same < expected->length)
        fail_msg("bash: ...%.40s\nglint: ...%.40s", a + (same < 20 ? 0 : same - 20),
                 b + (same < 20 ? 0 : same - 20));
}

static void expect_input(const char *text, const char *input)
{
    struct pipeline pipeline;
    assert_done(parse, text, &pipeline, check_arena());
    assert_non_null(pipeline.input);
    assert_int_equal(pipeline.input_length, strlen(input));
    assert_memory_equal(pipeline.input, input, strlen(input));
}

TEST(a_here_document_is_what_bash_gives_the_first_command)
{
    static const char *const cases[][2] = {
        {"cat - <<'END'\nEND\n", ""},
        {"cat <<'END'\n$one `two` \\\n\n END\nEND \n<<'END'\nEND\n",
         "$one `two` \\\n\n END\nEND \n<<'END'\n"},
        {"set -o pipefail # why\n cat <<'a b' - | cat |\n'a b'x\na b\n\n # more\n cat\n",
         "'a b'x\n"},
        {"cat - \\\n <<'E' # END\ntext\nEND\nE\n", "text\nEND\n"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct text *script = check_text();
        text_add_word(script, cases[i][0]);
        struct text *answer = asked_of_bash(script);
        text_add(answer, "", 1);
        assert_string_equal(answer->bytes, cases[i][1]);
        expect_input(cases[i][0], cases[i][1]);
    }
}

TEST(a_here_document_without_its_last_line_ends_with_the_text)
{
    expect_input("a <<'END'\none\ntw", "one\ntw");
    expect_input("a <<'END'\n", "");
    expect_input("a <<'END' | b", "");
}

TEST(everything_else_is_refused_with_its_line)
{
#define VARIABLE "variables and substitutions are not understood here"
#define PATTERN "file name patterns are not understood here"
#define REDIRECTION "redirections are not understood here (use -o FILE)"
#define MORE "only one pipeline of words and | is understood here"
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"", "1: a command is missing"},
        {"# nothing\n", "2: a command is missing"},
        {"set -o pipefail\n", "2: a command is missing"},
        {"a |", "1: a command is missing"},
        {"a |\n\n", "3: a command is missing"},
        {"| a", "1: a command is missing before |"},
        {"a | | b", "1: a command is missing before |"},
        {"a || b", "1: " MORE},
        {"a |& b", "1: " MORE},
        {"a && b", "1: " MORE},
        {"a; b", "1: " MORE},
        {"a &", "1: " MORE},
        {"a\nb", "2: a second pipeline"},
        {"a\n| b", "2: a second pipeline"},
        {"a | b\n\n\nset -o pipefail", "4: a second pipeline"},
        {"(a)", "1: " MORE},
        {"{ a; }", "1: " MORE},
        {"a {b,c}", "1: " MORE},
        {"! a", "1: " MORE},
        {"\n\na $x", "3: " VARIABLE},
        {"a \"$x\"", "1: " VARIABLE},
        {"a `b`", "1: " VARIABLE},
        {"a \"`b`\"", "1: " VARIABLE},
        {"a $'b'", "1: " VARIABLE},
        {"X=1 a", "1: variables are not understood here"},
        {"x=1", "1: variables are not understood here"},
        {"a *.json", "1: " PATTERN},
        {"a b?", "1: " PATTERN},
        {"a [b]", "1: " PATTERN},
        {"a ~/b", "1: " PATTERN},
        {"a >b", "1: " REDIRECTION},
        {"a 2>b", "1: " REDIRECTION},
        {"a <b", "1: " REDIRECTION},
        {"a <<b\nb\n", "1: " REDIRECTION},
        {"a <<''\n\n", "1: " REDIRECTION},
        {"a <<'b'c\nbc\n", "1: " REDIRECTION},
        {"a <<'b\nc'\n", "1: " REDIRECTION},
        {"a <<'b", "1: " REDIRECTION},
        {"<<'b' a\nb\n", "1: " REDIRECTION},
        {"a | b <<'c'\nc\n", "1: " REDIRECTION},
        {"a <<'b' <<'c'\nb\nc\n", "1: " REDIRECTION},
        {"set -o pipefail <<'b'\nb\na\n", "1: of set, only `set -o pipefail` is understood here"},
        {"a <<'b'\nb\nc\n", "3: a second pipeline"},
        {"a 'b\nc", "2: a quote is not closed"},
        {"a \"b\nc\n", "3: a quote is not closed"},
        {"a \"b\\", "1: a quote is not closed"}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct pipeline pipeline;
        char message[128];
        snprintf(message, sizeof message, "%s; run it with bash", cases[i].message);
        assert_refused(DIAG_USAGE, message, parse, cases[i].text, &pipeline, check_arena());
    }
}

TEST(commands_know_their_lines)
{
    struct pipeline pipeline;
    assert_done(parse, "# x\n\na 'b\nc' \\\n d |\n\n e | f", &pipeline, check_arena());
    assert_int_equal(pipeline.commands.count, 3);
    assert_int_equal(pipeline.commands.items[0].line, 3);
    assert_int_equal(pipeline.commands.items[1].line, 7);
    assert_int_equal(pipeline.commands.items[2].line, 7);
}

TEST(a_nul_byte_is_refused)
{
    static const char text[] = "a b | c d";
    for (size_t i = 0; i < sizeof text - 1; i++) {
        struct pipeline pipeline;
        struct diag diag = {0};
        char with[sizeof text];
        memcpy(with, text, sizeof text);
        with[i] = '\0';
        assert_int_equal(pipeline_parse(with, sizeof text - 1, &pipeline, check_arena(), &diag),
                         -1);
    }
}
