#include "check.h"

#include "text/file_format.h"

static bool explains(const char *kind, const char *bytes, enum diag_code code, struct diag *diag)
{
    *diag = (struct diag){0};
    diag_fail(diag, code, "as it was");
    return file_format_explain(kind, bytes, strlen(bytes), diag);
}

TEST(another_format_is_named_and_the_code_stays)
{
    struct diag diag;
    assert_true(explains("frame", "\xef\xbb\xbf <a><fcd-export>", DIAG_DATA, &diag));
    assert_string_equal(diag.text, "SUMO's floating car data; glint-traffic-sumo reads it");
    assert_int_equal(diag.code, DIAG_DATA);
    assert_true(explains("sensor suite", "<fcd-export>", DIAG_CONFIG, &diag));
    assert_int_equal(diag.code, DIAG_CONFIG);
}

TEST(a_reader_keeps_its_message_for_its_own_format_and_for_unknown_ones)
{
    struct diag diag;
    assert_false(explains("floating car data", "<fcd-export>", DIAG_DATA, &diag));
    assert_string_equal(diag.text, "as it was");
    assert_false(explains("frame", "<strange>", DIAG_DATA, &diag));
    assert_string_equal(diag.text, "as it was");
    assert_false(explains("frame", "", DIAG_DATA, &diag));
}

TEST(a_file_that_cannot_be_read_is_of_no_format)
{
    struct diag diag;
    assert_false(explains("frame", "<fcd-export>", DIAG_IO, &diag));
    assert_false(explains("frame", "<fcd-export>", DIAG_NO_INPUT, &diag));
}

TEST(encodings_that_no_reader_takes_are_named_before_what_they_hold)
{
    struct diag diag;
    assert_true(explains("frame", "\xef\xbb\xbf{\"version\":1}", DIAG_DATA, &diag));
    assert_string_equal(diag.text, "JSON behind a byte order mark; tail -c +4 leaves the mark out");
    assert_string_equal(file_format_of("\xff\xfe{\0\"\0", 6)->name, "text in UTF-16");
    assert_string_equal(file_format_of("\xfe\xff\0{\0\"", 6)->name, "text in UTF-16");
    assert_null(file_format_of("\n\xff\xfe{\0", 5));
}

TEST(words_count_only_behind_the_right_beginning)
{
    static const char frame[] = "{\"version\":1,\"scene\":\"<fcd-export xCenter trackId\"";
    assert_string_equal(file_format_of(frame, strlen(frame))->kind, "frame");
    assert_null(file_format_of("fcd-export>", 11));
    assert_null(file_format_of("text <fcd-export>", 17));
}

TEST(a_message_of_osi_stands_behind_its_length)
{
    assert_string_equal(file_format_of("\x10\0\0\0\n\x02", 6)->kind, "osi");
    assert_null(file_format_of("\x10\0\0\1\n\x02", 6));
    assert_null(file_format_of("\x10\0\0\0", 4));
}

TEST(cut_bytes_are_read_no_further)
{
    static const char text[] = "<?xml?><commonRoad>";
    size_t fits = strlen("<?xml?><commonRoad");
    char *exact = test_malloc(fits);
    memcpy(exact, text, fits);
    assert_string_equal(file_format_of(exact, fits)->kind, "commonroad");
    assert_null(file_format_of(exact, fits - 1));
    test_free(exact);
}
