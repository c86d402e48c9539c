#include "check.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "sample.h"

static bool stands_for_itself(char byte)
{
    return byte >= 0x20 && byte < 0x7f && byte != '"' && byte != '\\';
}

/* Every byte is tried at every place among plain bytes, and among others. */
static void plain_bytes_end_at_the_first_other_byte(void **state)
{
    (void)state;
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

static void a_word_has_its_first_byte_lowest(void **state)
{
    (void)state;
    static const char bytes[] = "\x01\x02\x03\x04\x05\x06\x07\xff";
    char written[8];
    assert_true(text_word(bytes) == UINT64_C(0xff07060504030201));
    text_put_word(written, text_word(bytes));
    assert_memory_equal(written, bytes, 8);
    for (size_t length = 0; length <= 8; length++)
        assert_true(text_short_word(bytes, length) ==
                    (length == 0 ? 0 : text_word(bytes) << 8 * (8 - length) >> 8 * (8 - length)));
}

static void strings_are_escaped_no_more_than_json_requires(void **state)
{
    (void)state;
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
static void room_for_a_string_is_room_for_its_escapes(void **state)
{
    (void)state;
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_bytes_end_at_the_first_other_byte),
        cmocka_unit_test(a_word_has_its_first_byte_lowest),
        cmocka_unit_test(strings_are_escaped_no_more_than_json_requires),
        cmocka_unit_test(room_for_a_string_is_room_for_its_escapes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
