#include "check.h"

#include "base/text.h"
#include "sample.h"

static bool stands_for_itself(char byte)
{
    return byte >= 0x20 && byte < 0x7f && byte != '"' && byte != '\\';
}

/* Every byte is tried at every place among plain bytes, and among others. */
TEST(plain_bytes_end_at_the_first_other_byte)
{
    for (size_t length = 0; length <= 20; length++) {
        for (size_t place = 0; place < length; place++) {
            for (unsigned byte = 0; byte < 256; byte++) {
                /* Exactly this much memory, so that a sanitizer sees a step beyond the end. */
                char *bytes = malloc(length);
                memset(bytes, byte % 2 ? '!' : '~', length);
                bytes[place] = (char)byte;
                if (place + 1 < length)
                    bytes[place + 1] = (char)(byte * 7);
                size_t expected = 0;
                while (expected < length && stands_for_itself(bytes[expected]))
                    expected++;
                assert_int_equal(text_plain(bytes, length), expected);
                free(bytes);
            }
        }
    }
}

/* The first and the last character of each length, around the surrogates, and what lies beside. */
TEST(characters_of_utf8_have_their_lengths_and_nothing_else_has_one)
{
    static const char *const characters[] = {
        "\x01",         "\x7f",         "\xc2\x80",     "\xdf\xbf",         "\xe0\xa0\x80",
        "\xed\x9f\xbf", "\xee\x80\x80", "\xef\xbf\xbf", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf",
    };
    static const char *const others[] = {
        "\x80\x80\x80\x80", "\xc1\xbf\x80\x80", "\xc2\x7f\x80\x80", "\xe0\x9f\xbf\x80",
        "\xe1\x80\x7f\x80", "\xed\xa0\x80\x80", "\xf0\x8f\xbf\xbf", "\xf1\x80\x80\x7f",
        "\xf1\x80\xc0\x80", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff\x80\x80\x80",
    };
    for (size_t i = 0; i < sizeof characters / sizeof *characters; i++)
        for (size_t room = 0; room <= 4; room++) {
            size_t length = strlen(characters[i]);
            assert_int_equal(text_utf8(characters[i], room), room < length ? 0 : length);
        }
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        assert_int_equal(text_utf8(others[i], 4), 0);
}

TEST(a_word_has_its_first_byte_lowest)
{
    static const char bytes[] = "\x01\x02\x03\x04\x05\x06\x07\xff";
    char written[8];
    assert_true(text_word(bytes) == UINT64_C(0xff07060504030201));
    text_put_word(written, text_word(bytes));
    assert_memory_equal(written, bytes, 8);
    for (size_t length = 0; length <= 8; length++)
        assert_true(text_short_word(bytes, length) ==
                    (length == 0 ? 0 : text_word(bytes) << 8 * (8 - length) >> 8 * (8 - length)));
}

TEST(strings_are_escaped_no_more_than_json_requires)
{
    static const char given[] = "\x01\x1f a\"b\\c/\x7f\xc3\xa9\xf0\x9f\x98\x80 a longer run\n";
    static const char expected[] =
        "\"\\u0001\\u001f a\\\"b\\\\c/\x7f\xc3\xa9\xf0\x9f\x98\x80 a longer run\\u000a\"";
    struct text text = {0};
    text_add_json(&text, given, sizeof given - 1);
    assert_int_equal(text.length, sizeof expected - 1);
    assert_memory_equal(text.bytes, expected, text.length);
    text_free(&text);
}

/* The longest text: every byte is an escape of six characters. */
TEST(room_for_a_string_is_room_for_its_escapes)
{
    for (size_t length = 0; length < 100; length++) {
        for (size_t plain = 0; plain <= length; plain++) {
            char bytes[100];
            memset(bytes, '\x02', sizeof bytes);
            memset(bytes, 'a', plain);
            char *room = malloc(text_json_size(length));
            assert_true(text_put_json(room, bytes, length) == room + 6 * length - 5 * plain + 2);
            free(room);
        }
    }
}
