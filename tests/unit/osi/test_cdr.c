#include "check.h"

#include "osi/cdr.h"

static void assert_bytes(const struct text *text, const char *expected, size_t size)
{
    assert_int_equal(text->length, size);
    assert_memory_equal(text->bytes, expected, size);
}

#define ASSERT_BYTES(text, ...)                                                                    \
    assert_bytes(text, (const char[]){__VA_ARGS__}, sizeof((const char[]){__VA_ARGS__}))

TEST(a_number_stands_at_a_multiple_of_its_size_behind_the_four_bytes_of_the_encoding)
{
    struct text text = {0};
    struct cdr cdr = cdr_begin(&text);
    cdr_add_uint8(&cdr, 0x11);
    cdr_add_uint32(&cdr, 0x44332221);
    cdr_add_uint8(&cdr, 0x51);
    cdr_add_float64(&cdr, 1);
    cdr_add_uint8(&cdr, 0x61);
    cdr_add_int32(&cdr, -2);
    ASSERT_BYTES(&text, 0, 1, 0, 0, 0x11, 0, 0, 0, 0x21, 0x22, 0x33, 0x44, 0x51, 0, 0, 0, 0, 0, 0,
                 0, 0, 0, 0, 0, 0, 0, (char)0xf0, 0x3f, 0x61, 0, 0, 0, (char)0xfe, (char)0xff,
                 (char)0xff, (char)0xff);
    text_free(&text);
}

TEST(a_string_is_the_number_of_its_bytes_with_its_nul_and_the_bytes)
{
    struct text text = {0};
    struct cdr cdr = cdr_begin(&text);
    cdr_add_string(&cdr, "");
    cdr_add_string(&cdr, "ab");
    ASSERT_BYTES(&text, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 'a', 'b', 0);
    text_free(&text);
}

TEST(a_message_behind_other_bytes_counts_from_its_own_begin)
{
    struct text text = {0};
    text_add_word(&text, "abc");
    struct cdr cdr = cdr_begin(&text);
    cdr_add_uint8(&cdr, 1);
    cdr_add_uint32(&cdr, 2);
    ASSERT_BYTES(&text, 'a', 'b', 'c', 0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0);
    text_free(&text);
}

static void add_field(struct cdr *cdr, const char *name, uint32_t offset)
{
    cdr_add_string(cdr, name);
    cdr_add_uint32(cdr, offset);
    cdr_add_uint8(cdr, 7);
    cdr_add_uint32(cdr, 1);
}

/* A PointCloud2 of one point at 1.25 s, of which @foxglove/rosmsg2-serialization writes the same
 * bytes. */
TEST(a_point_cloud_has_the_bytes_that_another_writer_gives_it)
{
    static const uint32_t expected[] = {
        0x00000100, 0x00000001, 0x0ee6b280, 0x00000006, 0x61646172, 0x00000072, 0x00000001,
        0x00000001, 0x00000004, 0x00000002, 0x00000078, 0x00000000, 0x00000007, 0x00000001,
        0x00000002, 0x00000079, 0x00000004, 0x00000007, 0x00000001, 0x00000002, 0x0000007a,
        0x00000008, 0x00000007, 0x00000001, 0x00000002, 0x00000076, 0x0000000c, 0x00000007,
        0x00000001, 0x00000000, 0x00000010, 0x00000010, 0x00000010, 0x41200000, 0xc0200000,
        0x00000000, 0xbfc00000};
    static const char *const names[] = {"x", "y", "z", "v"};
    static const float point[] = {10, -2.5F, 0, -1.5F};
    struct text text = {0};
    struct cdr cdr = cdr_begin(&text);
    cdr_add_int32(&cdr, 1);
    cdr_add_uint32(&cdr, 250000000);
    cdr_add_string(&cdr, "radar");
    cdr_add_uint32(&cdr, 1);
    cdr_add_uint32(&cdr, 1);
    cdr_add_uint32(&cdr, 4);
    for (uint32_t i = 0; i < 4; i++)
        add_field(&cdr, names[i], 4 * i);
    cdr_add_uint8(&cdr, 0);
    for (int i = 0; i < 3; i++)
        cdr_add_uint32(&cdr, sizeof point);
    for (int i = 0; i < 4; i++)
        cdr_add_float32(&cdr, point[i]);
    cdr_add_uint8(&cdr, 1);
    assert_int_equal(text.length, sizeof expected + 1);
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        assert_int_equal(text_half_word(text.bytes + 4 * i), expected[i]);
    assert_int_equal(text.bytes[sizeof expected], 1);
    text_free(&text);
}
