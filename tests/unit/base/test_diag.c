#include "check.h"

#include <unistd.h>

#include "base/diag.h"

/* What diag_print writes to stderr. */
static void print(const char *text, char *printed, size_t size)
{
    struct diag diag = {0};
    FILE *file = tmpfile();
    int kept = dup(STDERR_FILENO);
    assert_non_null(file);
    diag_fail(&diag, DIAG_DATA, "%s", text);
    fflush(stderr);
    dup2(fileno(file), STDERR_FILENO);
    diag_print("glint", &diag);
    fflush(stderr);
    dup2(kept, STDERR_FILENO);
    close(kept);
    rewind(file);
    size_t length = fread(printed, 1, size - 1, file);
    printed[length] = '\0';
    fclose(file);
}

TEST(a_message_is_one_line_whatever_a_name_in_it_holds)
{
    static const char *const texts[][2] = {
        {"plain ~ text", "plain ~ text"},
        {"\x01\x1f \x7f\x80", "\\x01\\x1f \\x7f\x80"},
        {"a\nb\x1b[2J", "a\\x0ab\\x1b[2J"},
        {"\xc2\x80\xc2\x9f\xc2\xa0", "\\x80\\x9f\xc2\xa0"},
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        char printed[200], expected[200];
        print(texts[i][0], printed, sizeof printed);
        snprintf(expected, sizeof expected, "glint: %s\n", texts[i][1]);
        assert_string_equal(printed, expected);
    }
}

TEST(the_first_message_stays_and_prefixes_stand_before_it)
{
    struct diag diag = {0};
    assert_int_equal(diag_fail(&diag, DIAG_DATA, "%d of %s", 3, "four"), -1);
    assert_int_equal(diag_fail(&diag, DIAG_IO, "another"), -1);
    assert_int_equal(diag_prefix(&diag, "%s:%d: ", "file", 7), -1);
    assert_int_equal(diag.code, DIAG_DATA);
    assert_string_equal(diag.text, "file:7: 3 of four");
}

TEST(a_prefix_that_leaves_no_room_is_left_out)
{
    struct diag diag = {0};
    char longest[sizeof diag.text];
    memset(longest, 'a', sizeof longest);
    longest[sizeof longest - 1] = '\0';
    diag_fail(&diag, DIAG_DATA, "cause");
    diag_prefix(&diag, "%s: ", longest);
    assert_string_equal(diag.text, "cause");
    longest[sizeof longest - 4] = '\0';
    diag_prefix(&diag, "%s", longest);
    assert_int_equal(strlen(diag.text), sizeof longest - 1);
    assert_string_equal(diag.text + sizeof longest - 4, "cau");
}
