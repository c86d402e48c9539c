#include "text/terminal.h"

#include <unistd.h>

#include "check.h"

static void assert_fit(const char *text, size_t columns, const char *expected)
{
    struct text fitted = {0};
    text_add_word(&fitted, text);
    terminal_fit(&fitted, columns);
    text_add(&fitted, "", 1);
    assert_string_equal(fitted.bytes, expected);
    text_free(&fitted);
}

TEST(lines_break_at_the_last_blank_that_leaves_room)
{
    assert_fit("one two three\n\nfour\n", 13, "one two three\n\nfour\n");
    assert_fit("one two three\n", 12, "one two\nthree\n");
    assert_fit("one two three\n", 7, "one two\nthree\n");
    assert_fit("one two three\n", 6, "one\ntwo\nthree\n");
    assert_fit("one two three\n", 0, "one two three\n");
}

TEST(letters_of_several_bytes_are_one_column)
{
    assert_fit("\xc3\xa4\xc3\xb6\xc3\xbc \xe2\x82\xac\n", 5,
               "\xc3\xa4\xc3\xb6\xc3\xbc \xe2\x82\xac\n");
}

TEST(words_that_are_too_wide_stay_whole)
{
    assert_fit("a very_long_word b c\n", 5, "a\nvery_long_word\nb c\n");
    assert_fit("very_long_word\n", 5, "very_long_word\n");
}

TEST(lines_of_tables_go_on_behind_four_blanks)
{
    assert_fit("name    12  on and off again\n", 19, "name    12  on and\n    off again\n");
    assert_fit("name    12  on and off again\n", 10,
               "name    12\n    on and\n    off\n    again\n");
}

TEST(comments_go_on_as_comments)
{
    assert_fit("# one two three\n", 12, "# one two\n# three\n");
    assert_fit("# one  two three\n#\n", 12, "# one  two\n#     three\n#\n");
}

TEST(commands_over_several_lines_stay_as_they_are)
{
    assert_fit("one two three \\\n  | four five six\nseven eight nine\n", 10,
               "one two three \\\n  | four five six\nseven\neight nine\n");
}

TEST(what_is_no_terminal_has_no_columns)
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(terminal_columns(ends[1]), 0);
    close(ends[0]);
    close(ends[1]);
}
