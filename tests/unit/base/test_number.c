#include "check.h"

#include <float.h>

#include "base/number.h"
#include "sample.h"

static const char *text_of(double value, char text[NUMBER_SIZE + 1])
{
    size_t length = number_write(value, text);
    assert_in_range(length, 1, NUMBER_SIZE);
    text[length] = '\0';
    return text;
}

static bool reads(const char *text, double *value)
{
    return number_read(text, text + strlen(text), value);
}

/* The significant digits of a text: without leading zeros, point, sign, exponent, and zeros that
 * only hold a place. */
static size_t digits_in(const char *text)
{
    char digits[NUMBER_SIZE + 8];
    size_t count = 0;
    for (; *text != '\0' && *text != 'e'; text++)
        if (*text >= '0' && *text <= '9' && (*text != '0' || count > 0))
            digits[count++] = *text;
    while (count > 0 && digits[count - 1] == '0')
        count--;
    return count;
}

TEST(a_million_bit_patterns_come_back)
{
    uint64_t random = 1;
    for (int i = 0; i < 1000000; i++) {
        double value = sample_from_bits(sample_bits(&random) << 16 ^ sample_bits(&random)), back;
        if (!isfinite(value))
            continue;
        char text[NUMBER_SIZE + 1];
        if (!reads(text_of(value, text), &back) || memcmp(&back, &value, sizeof back) != 0)
            fail_msg("%.17g became %s", value, text);
    }
}

/* Checked with %.*e: one digit less than were written must not restore the double. */
TEST(no_shorter_decimal_would_do)
{
    uint64_t random = 2;
    for (int i = 0; i < 100000; i++) {
        double value = i % 2 ? sample_from_bits(sample_bits(&random) << 16 ^ sample_bits(&random))
                             : (double)sample_integer(&random, 1000000) / 1000;
        if (!isfinite(value) || value == 0)
            continue;
        char text[NUMBER_SIZE + 1], plain[64];
        size_t digits = digits_in(text_of(value, text));
        snprintf(plain, sizeof plain, "%.17g", value);
        assert_true(strlen(text) <= strlen(plain));
        /* Large whole numbers are written out to the last digit where that is not longer. */
        if (strpbrk(text, ".e") == NULL && fabs(value) > 0x1p53)
            continue;
        assert_in_range(digits, 1, 17);
        if (digits > 1) {
            snprintf(plain, sizeof plain, "%.*e", (int)digits - 2, value);
            assert_true(strtod(plain, NULL) != value);
        }
    }
}

/* C's printf rounds exactly, ties to even: its shortest text that reads back, in fixed notation. */
static const char *by_trial(double value, char *plain, size_t size)
{
    char digits[64];
    int precision = 0;
    do
        snprintf(digits, sizeof digits, "%.*e", precision++, value);
    while (strtod(digits, NULL) != value);
    int exponent = atoi(strchr(digits, 'e') + 1), places = precision - 1 - exponent;
    snprintf(plain, size, "%.*f", places > 0 ? places : 0, value);
    return plain;
}

static double usual_number(uint64_t *random, int kind)
{
    switch (kind) {
    case 0:
        return sample_between(random, 1e-3, 1) * (double)(1 + sample_bits(random) % 99999);
    case 1:
        return (double)sample_integer(random, 999999999) / 1e4;
    case 2: /* few bits: many lie midway between two decimals of 17 digits */
        return 65536 + (double)(sample_bits(random) % (1 << 24)) * 0x1p-12;
    case 3: /* beside the powers of two, where the doubles' spacing changes */
        return sample_from_bits((uint64_t)(1014 + sample_bits(random) % 25) << 52) *
               (1 + (double)sample_integer(random, 3) * 0x1p-52);
    default:
        return sample_from_bits((uint64_t)(1014 + sample_bits(random) % 25) << 52 |
                                (sample_bits(random) << 4 & UINT64_MAX << sample_bits(random) % 52 &
                                 UINT64_C(0x000fffffffffffff)));
    }
}

TEST(the_nearest_of_the_shortest_decimals_is_written)
{
    uint64_t random = 4;
    for (int i = 0; i < 300000; i++) {
        double value = usual_number(&random, i % 5);
        char text[NUMBER_SIZE + 1], plain[64];
        if (fabs(value) < 1e-3 || fabs(value) >= 1e5)
            continue;
        assert_string_equal(text_of(value, text), by_trial(value, plain, sizeof plain));
        assert_string_equal(text_of(-value, text) + (value < 0 ? 0 : 1), plain + (value < 0));
    }
}

TEST(numbers_look_as_people_write_them)
{
    static const struct {
        double value;
        const char *text;
    } cases[] = {{0, "0"},
                 {-0.0, "-0.0"},
                 {1, "1"},
                 {-1.5, "-1.5"},
                 {0.1, "0.1"},
                 {0.3, "0.3"},
                 {0.1 + 0.2, "0.30000000000000004"},
                 {1e22, "1e+22"},
                 {123456, "123456"},
                 {99999, "99999"},
                 {100000, "1e+05"},
                 {99999.99999999999, "99999.99999999999"},
                 {0.001, "0.001"},
                 {0.0009, "9e-04"},
                 {-0.0625, "-0.0625"},
                 {65536.000244140625, "65536.00024414062"},
                 {65536.000732421875, "65536.00073242188"},
                 {1e-7, "1e-07"},
                 {5e-324, "5e-324"},
                 {DBL_MIN, "2.2250738585072014e-308"},
                 {DBL_MAX, "1.7976931348623157e+308"},
                 {9007199254740993.0, "9007199254740992"},
                 {123456789012345680000.0, "123456789012345683968"},
                 {1.5e300, "1.5e+300"},
                 /* 5e22 is midway between these two and reads as the even one. */
                 {5960464477539062 * 0x1p23, "5e+22"},
                 {5960464477539063 * 0x1p23, "5.0000000000000004e+22"},
                 {-1.25e-5, "-1.25e-05"},
                 {0x1p-1022 - 0x1p-1074, "2.225073858507201e-308"},
                 {3.14159265358979323846, "3.141592653589793"}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        char text[NUMBER_SIZE + 1];
        assert_string_equal(text_of(cases[i].value, text), cases[i].text);
    }
}

TEST(subnormals_and_the_ends_of_the_range_come_back)
{
    for (uint64_t near = 0; near < 2000; near++) {
        const uint64_t places[] = {
            near, UINT64_C(0x0010000000000000) - 1000 + near, UINT64_C(0x7fefffffffffffff) - near,
            UINT64_C(0x8000000000000000) + near, UINT64_C(0x3ff0000000000000) - 1000 + near};
        for (size_t i = 0; i < COUNT(places); i++) {
            char text[NUMBER_SIZE + 1];
            double value = sample_from_bits(places[i]), back;
            assert_true(reads(text_of(value, text), &back));
            assert_memory_equal(&back, &value, sizeof value);
        }
    }
}

TEST(too_large_numbers_are_refused_and_too_small_ones_are_zero)
{
    static const char *const large[] = {
        "1e309",        "-1e309", "1.7976931348623159e308", "1e400", "1e99999999999999999999",
        "123456789e301"};
    static const char *const small[] = {
        "1e-400", "0.0000e-5", "2e-324", "1e-99999999999999999999", "0e99999999999999999999",
        "0e400"};
    double value;
    for (size_t i = 0; i < COUNT(large); i++)
        if (reads(large[i], &value))
            fail_msg("%s was taken as %g", large[i], value);
    for (size_t i = 0; i < COUNT(small); i++) {
        char negative[64];
        snprintf(negative, sizeof negative, "-%s", small[i]);
        assert_true(reads(small[i], &value));
        assert_true(value == 0 && !signbit(value));
        assert_true(reads(negative, &value));
        assert_true(value == 0 && signbit(value));
    }
    assert_true(reads("1.7976931348623158e308", &value) && value == DBL_MAX);
    assert_true(reads("3e-324", &value) && value == sample_from_bits(1));
    assert_true(reads("2.2250738585072011e-308", &value) &&
                value == sample_from_bits(UINT64_C(0x000fffffffffffff)));
}

TEST(decimals_round_to_the_nearest_double)
{
    uint64_t random = 3;
    for (int i = 0; i < 200000; i++) {
        char text[80];
        int length = snprintf(text, sizeof text, "%s%llu", i % 2 ? "-" : "",
                              (unsigned long long)sample_bits(&random));
        if (i % 3 > 0)
            length += snprintf(text + length, sizeof text - (size_t)length, ".%0*llu",
                               1 + (int)(sample_bits(&random) % 25),
                               (unsigned long long)sample_bits(&random));
        if (i % 5 > 0)
            snprintf(text + length, sizeof text - (size_t)length, "%c%lld", i % 2 ? 'e' : 'E',
                     (long long)sample_integer(&random, 330));
        double value, expected = strtod(text, NULL);
        assert_int_equal(reads(text, &value), isfinite(expected));
        if (isfinite(expected) && memcmp(&value, &expected, sizeof value) != 0)
            fail_msg("%s became %.17g", text, value);
    }
    /* Exactly between two doubles the even one is taken; a digit far behind decides. */
    double value;
    assert_true(reads("9007199254740993", &value) && value == 9007199254740992.0);
    assert_true(reads("9007199254740995", &value) && value == 9007199254740996.0);
    assert_true(reads("9007199254740993.00000000000000000000000000000000001", &value) &&
                value == 9007199254740994.0);
}

/* Among more digits than a double can tell, the last one may decide, zeros in front count nothing,
 * and the exponent may take back what the digits say. */
TEST(numbers_of_a_thousand_digits_are_read_exactly)
{
    char text[3000];
    double value;
    int length = snprintf(text, sizeof text, "1.%01000d", 0);
    assert_true(reads(text, &value) && value == 1);
    snprintf(text + length, sizeof text - (size_t)length, "1");
    assert_true(reads(text, &value) && value == 1);
    snprintf(text, sizeof text, "9007199254740993.%01000d1", 0);
    assert_true(reads(text, &value) && value == 9007199254740994.0);
    snprintf(text, sizeof text, "0.%01000d15e1001", 0);
    assert_true(reads(text, &value) && value == 1.5);
    snprintf(text, sizeof text, "15%01000de-1001", 0);
    assert_true(reads(text, &value) && value == 1.5);
    snprintf(text, sizeof text, "%01000d15e-1", 0);
    assert_true(reads(text, &value) && value == 1.5);
    snprintf(text, sizeof text, "0.%01000d", 0);
    assert_true(reads(text, &value) && value == 0);
}

TEST(digits_and_places_round_to_the_nearest_double)
{
    uint64_t random = 6;
    for (int i = 0; i < 300000; i++) {
        int places = (int)(sample_bits(&random) % (NUMBER_DIGITS + 1));
        uint64_t digits =
            (sample_bits(&random) << 16 ^ sample_bits(&random)) >> sample_bits(&random) % 64;
        if (i % 3 == 0) { /* exactly between two doubles, or one off */
            places = (int)(sample_bits(&random) % 4);
            digits =
                UINT64_C(1) << 53 | (sample_bits(&random) << 6 ^ sample_bits(&random)) >> 11 | 1;
            for (int power = 0; power < places; power++)
                digits *= 5;
            digits += (uint64_t)sample_integer(&random, 1);
        }
        char text[64];
        snprintf(text, sizeof text, "%llue-%d", (unsigned long long)digits, places);
        double value = number_of_digits(digits, places), expected = strtod(text, NULL);
        if (memcmp(&value, &expected, sizeof value) != 0)
            fail_msg("%s became %.17g", text, value);
    }
    assert_true(number_of_digits(UINT64_MAX, 0) == 0x1p64);
    assert_true(number_of_digits(0, NUMBER_DIGITS) == 0);
}

/* A number with this many digits before and behind the point, and where it ends. */
static size_t put_number(char *text, uint64_t *random, int whole, int fraction)
{
    size_t length = 0;
    if (sample_bits(random) % 2 != 0)
        text[length++] = '-';
    for (int i = 0; i < whole; i++)
        text[length++] = (char)('0' + (i == 0 && whole > 1 ? 1 + sample_bits(random) % 9
                                                           : sample_bits(random) % 10));
    if (fraction > 0)
        text[length++] = '.';
    for (int i = 0; i < fraction; i++)
        text[length++] = (char)('0' + sample_bits(random) % 10);
    return length;
}

TEST(everyday_numbers_are_taken_from_the_beginning)
{
    uint64_t random = 7;
    for (int i = 0; i < 300000; i++) {
        int whole = 1 + (int)(sample_bits(&random) % 10);
        int fraction = (int)(sample_bits(&random) % 24);
        size_t more = i % 2 ? sample_bits(&random) % 80 : 0;
        char text[128];
        size_t length = put_number(text, &random, whole, fraction);
        memset(text + length, i % 3 ? ',' : ' ', more);
        /* Exactly this much memory, for a sanitizer to see. */
        char *bare = malloc(length + more);
        memcpy(bare, text, length + more);
        double value, expected;
        const char *end = number_take(bare, bare + length + more, &value);
        text[length] = '\0';
        expected = strtod(text, NULL);
        if (whole < 9 && fraction + whole <= NUMBER_DIGITS)
            assert_non_null(end);
        if (end != NULL) {
            assert_ptr_equal(end, bare + length);
            if (memcmp(&value, &expected, sizeof value) != 0)
                fail_msg("%s became %.17g", text, value);
        }
        free(bare);
    }
}

TEST(other_numbers_and_texts_are_not_taken)
{
    static const char *const others[] = {
        "",     "-",   ",1",   ".5",   "-.5", "+1",   "1.",
        "1.,",  "01",  "-00",  "00.5", "1e5", "1E5",  "1.5e",
        "0e+1", "inf", "-inf", "nan",  "0x1", "1.5E", "1234567890123.5"};
    for (size_t i = 0; i < COUNT(others); i++) {
        char text[128];
        size_t length = strlen(others[i]);
        memset(text, ' ', sizeof text);
        memcpy(text, others[i], length);
        double value;
        const char *end = number_take(text, text + length, &value);
        if (strcmp(others[i], "0x1") == 0)
            assert_ptr_equal(end, text + 1);
        else
            assert_null(end);
        assert_true((number_take(text, text + sizeof text, &value) == NULL) == (end == NULL));
    }
}

TEST(whole_numbers_are_written_in_full)
{
    char text[NUMBER_SIZE];
    assert_int_equal(number_write_whole(UINT64_MAX, text), 20);
    assert_memory_equal(text, "18446744073709551615", 20);
    for (uint64_t value = UINT64_MAX; value > 0; value /= 3) {
        char expected[NUMBER_SIZE];
        int length = snprintf(expected, sizeof expected, "%llu", (unsigned long long)value);
        assert_int_equal(number_write_whole(value, text), length);
        assert_memory_equal(text, expected, (size_t)length);
    }
    assert_int_equal(number_write_whole(0, text), 1);
    assert_memory_equal(text, "0", 1);
}

TEST(nothing_may_follow_the_number)
{
    static const char *const texts[] = {"1x",    "1 ",  " 1",  "1e", "1e+", "-",
                                        "1.2.3", "+1",  "--1", "x",  "1,5", "",
                                        "inf",   "nan", "0x1", ".",  "e5",  "1e5e5"};
    double value;
    for (size_t i = 0; i < COUNT(texts); i++)
        if (reads(texts[i], &value))
            fail_msg("\"%s\" was taken", texts[i]);
}
