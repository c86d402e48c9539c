#include "base/number.h"

#include <math.h>

#include "base/decimal.h"
#include "base/text.h"

__extension__ typedef unsigned __int128 wide;

enum {
    MANTISSA_BITS = 52,
    EXPONENT_BIAS = 1075,
    DIGITS = 17,
    EIGHT_DIGITS = 100000000,
    MOST_TENS = 22,
    /* Up to here one more digit and seven behind the point still fit a double. */
    WHOLE_MOST = 10000000
};

/* Of such numbers, those of four places need no exponent. */
#define FOUR_PLACES_FROM 1e-3
#define FOUR_PLACES_TO 1e5

/* In this range shortest_multiple holds. */
#define PRODUCT_FROM 1e-9
#define PRODUCT_TO 1e15

/* number_take looks at fewer bytes. */
_Static_assert(NUMBER_ROOM > 1 + 8 + 1 + 8 + NUMBER_DIGITS, "a sign, a point and all digits");

#define BYTES UINT64_C(0x0101010101010101)

/* All powers of ten that are doubles. */
static const double TENS[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                              1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                              1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

static const uint64_t WHOLE_TENS[] = {1,      10,      100,      1000,     10000,
                                      100000, 1000000, 10000000, 100000000};

/* The powers of five, shifted up to 64 bits, and 2^128 divided by each, less 2^64: a product with
 * this inverse replaces the division (N. Moeller and T. Granlund, Improved division by invariant
 * integers, 2011). */
static const struct {
    uint64_t divisor, inverse;
} FIVES[DECIMAL_FIVES + 1] = {
    {UINT64_C(0x8000000000000000), UINT64_C(0xffffffffffffffff)},
    {UINT64_C(0xa000000000000000), UINT64_C(0x9999999999999999)},
    {UINT64_C(0xc800000000000000), UINT64_C(0x47ae147ae147ae14)},
    {UINT64_C(0xfa00000000000000), UINT64_C(0x0624dd2f1a9fbe76)},
    {UINT64_C(0x9c40000000000000), UINT64_C(0xa36e2eb1c432ca57)},
    {UINT64_C(0xc350000000000000), UINT64_C(0x4f8b588e368f0846)},
    {UINT64_C(0xf424000000000000), UINT64_C(0x0c6f7a0b5ed8d36b)},
    {UINT64_C(0x9896800000000000), UINT64_C(0xad7f29abcaf48578)},
    {UINT64_C(0xbebc200000000000), UINT64_C(0x5798ee2308c39df9)},
    {UINT64_C(0xee6b280000000000), UINT64_C(0x12e0be826d694b2e)},
    {UINT64_C(0x9502f90000000000), UINT64_C(0xb7cdfd9d7bdbab7d)},
    {UINT64_C(0xba43b74000000000), UINT64_C(0x5fd7fe17964955fd)},
    {UINT64_C(0xe8d4a51000000000), UINT64_C(0x19799812dea11197)},
    {UINT64_C(0x9184e72a00000000), UINT64_C(0xc25c268497681c26)},
    {UINT64_C(0xb5e620f480000000), UINT64_C(0x6849b86a12b9b01e)},
    {UINT64_C(0xe35fa931a0000000), UINT64_C(0x203af9ee756159b2)},
    {UINT64_C(0x8e1bc9bf04000000), UINT64_C(0xcd2b297d889bc2b6)},
    {UINT64_C(0xb1a2bc2ec5000000), UINT64_C(0x70ef54646d496892)},
    {UINT64_C(0xde0b6b3a76400000), UINT64_C(0x2725dd1d243aba0e)},
    {UINT64_C(0x8ac7230489e80000), UINT64_C(0xd83c94fb6d2ac34a)},
    {UINT64_C(0xad78ebc5ac620000), UINT64_C(0x79ca10c9242235d5)},
    {UINT64_C(0xd8d726b7177a8000), UINT64_C(0x2e3b40a0e9b4f7dd)},
    {UINT64_C(0x878678326eac9000), UINT64_C(0xe392010175ee5962)},
    {UINT64_C(0xa968163f0a57b400), UINT64_C(0x82db34012b25144e)},
    {UINT64_C(0xd3c21bcecceda100), UINT64_C(0x357c299a88ea76a5)},
    {UINT64_C(0x84595161401484a0), UINT64_C(0xef2d0f5da7dd8aa2)},
    {UINT64_C(0xa56fa5b99019a5c8), UINT64_C(0x8c240c4aecb13bb5)},
    {UINT64_C(0xcecb8f27f4200f3a), UINT64_C(0x3ce9a36f23c0fc90)},
};

static const char PAIRS[] = "0001020304050607080910111213141516171819"
                            "2021222324252627282930313233343536373839"
                            "4041424344454647484950515253545556575859"
                            "6061626364656667686970717273747576777879"
                            "8081828384858687888990919293949596979899";

static inline void put_four(uint32_t value, char *text)
{
    memcpy(text, PAIRS + (size_t)2 * (value / 100), 2);
    memcpy(text + 2, PAIRS + (size_t)2 * (value % 100), 2);
}

static inline void put_eight(uint32_t value, char *text)
{
    put_four(value / 10000, text);
    put_four(value % 10000, text + 4);
}

static char *without_zeros(char *end)
{
    while (end[-1] == '0')
        end--;
    return end;
}

/* Writes a number below 10^8; returns where it ends. */
static char *put_whole(uint32_t value, char *text)
{
    if (value < 10) {
        *text = (char)('0' + value);
        return text + 1;
    }
    char digits[16] = "00000000";
    put_eight(value, digits);
    const char *first = digits;
    while (*first == '0')
        first++;
    memcpy(text, first, 8);
    return text + (digits + 8 - first);
}

/* Writes value / 10^4; returns where it ends. */
static char *put_ten_thousandths(uint32_t value, char *text)
{
    const uint32_t fraction = value % 10000;
    text = put_whole(value / 10000, text);
    if (fraction == 0)
        return text;
    *text = '.';
    put_four(fraction, text + 1);
    return without_zeros(text + 5);
}

/* The shortest decimal that reads back to mantissa * 2^-scale, and the nearest of several, as a
 * multiple of 10^-places. places is the least number that puts at least one multiple between the
 * midpoints to both neighbours. So fewer than ten multiples lie there, and at most one multiple of
 * ten, which is then shorter. The product is exact in 128 bits, its fraction in 64. Ties go to the
 * even decimal. */
static uint64_t shortest_multiple(uint64_t mantissa, int scale, int places)
{
    const wide exact = (wide)mantissa * decimal_fives[places]; /* in units of 2^-shift */
    const int shift = scale - places;
    const uint64_t below = (uint64_t)(exact >> 64) << (64 - shift) | (uint64_t)exact >> shift;
    const uint64_t half = UINT64_C(1) << (shift - 1), rest = (uint64_t)exact & (2 * half - 1);
    /* The distance to the midpoints, in half units; the midpoints of an odd mantissa read back to
     * the neighbours. */
    const uint64_t reach = decimal_fives[places] - (mantissa & 1);
    const uint64_t tens = (below + ((2 * rest + reach) >> (shift + 1))) / 10 * 10;
    if (tens > below || (below - tens) * 4 * half + 2 * rest <= reach)
        return tens;
    return below + (rest > half || (rest == half && (below & 1)));
}

/* The shortest decimal that reads back to the double of these bits, which is not 0. */
static struct decimal shortest(uint64_t bits, double magnitude)
{
    const uint64_t one = UINT64_C(1) << MANTISSA_BITS, fraction = bits & (one - 1);
    /* Below a power of two the next double is nearer than above it. */
    if (!(magnitude >= PRODUCT_FROM && magnitude < PRODUCT_TO) || fraction == 0)
        return decimal_shortest(bits);
    const int scale = EXPONENT_BIAS - (int)(bits >> MANTISSA_BITS);
    const int places = 1 + (scale * 1233 >> 12); /* 1233 / 4096 is log10(2) */
    return (struct decimal){shortest_multiple(one | fraction, scale, places), places};
}

/* Writes a number below 10^17 with leading zeros. */
static void put_digits(uint64_t value, char *digits)
{
    digits[0] = (char)('0' + value / EIGHT_DIGITS / EIGHT_DIGITS);
    put_eight((uint32_t)(value / EIGHT_DIGITS % EIGHT_DIGITS), digits + 1);
    put_eight((uint32_t)(value % EIGHT_DIGITS), digits + 9);
}

/* A power of ten behind all digits that are written. */
static char *put_power(int exponent, char *text)
{
    const int size = exponent < 0 ? -exponent : exponent;
    memcpy(text, exponent < 0 ? "e-" : "e+", 2);
    text += 2;
    if (size >= 100)
        *text++ = (char)('0' + size / 100);
    memcpy(text, PAIRS + (size_t)2 * (size_t)(size % 100), 2);
    return text + 2;
}

static char *put_with_exponent(const char *digits, ptrdiff_t count, int exponent, char *text)
{
    *text++ = *digits;
    if (count > 1) {
        *text = '.';
        memcpy(text + 1, digits + 1, DIGITS);
        text += count;
    }
    return put_power(exponent, text);
}

/* Writes a whole number below 10^23 with all its digits. */
static char *put_large(double magnitude, char *text)
{
    const uint64_t unit = (uint64_t)EIGHT_DIGITS * EIGHT_DIGITS;
    const wide value = (wide)magnitude;
    if (value < unit)
        return text + number_write_whole((uint64_t)value, text);
    const uint64_t low = (uint64_t)(value % unit);
    text += number_write_whole((uint64_t)(value / unit), text);
    put_eight((uint32_t)(low / EIGHT_DIGITS), text);
    put_eight((uint32_t)(low % EIGHT_DIGITS), text + 8);
    return text + 16;
}

/* Writes the shortest decimal of a number; returns where it ends. An exponent takes four characters
 * and, if there are more digits than one, a point. */
static char *put_shortest(struct decimal decimal, double magnitude, char *text)
{
    char digits[2 * DIGITS];
    put_digits(decimal.digits, digits);
    const char *first = digits;
    while (*first == '0')
        first++;
    const ptrdiff_t count = without_zeros(digits + DIGITS) - first;
    const ptrdiff_t whole = digits + DIGITS - first - decimal.places;
    if (whole > 0 && whole < count) {
        memcpy(text, first, 16);
        text[whole] = '.';
        memcpy(text + whole + 1, first + whole, DIGITS);
        return text + count + 1;
    }
    const ptrdiff_t point = count > 1;
    if (whole < -2 - point || whole > count + 4 + point)
        return put_with_exponent(first, count, (int)whole - 1, text);
    if (whole > 0)
        return put_large(magnitude, text);
    memcpy(text, "0.000", 5);
    memcpy(text + 2 - whole, first, DIGITS);
    return text + 2 - whole + count;
}

/* Writes as many digits as it takes. Kept out of number_write, which would otherwise save registers
 * for every number. */
__attribute__((noinline)) static size_t write_long(double value, char *text)
{
    const double magnitude = fabs(value);
    uint64_t bits;
    memcpy(&bits, &magnitude, sizeof bits);
    *text = '-';
    char *const begin = text + (signbit(value) != 0);
    return (size_t)(put_shortest(shortest(bits, magnitude), magnitude, begin) - text);
}

size_t number_write(double value, char *text)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    if (bits == 0) {
        *text = '0';
        return 1;
    }
    const double magnitude = fabs(value);
    /* Two decimals of so few digits are never the same double, so no decimal is shorter. */
    const uint32_t near = magnitude < FOUR_PLACES_TO ? (uint32_t)(magnitude * 1e4 + 0.5) : 0;
    if (near / 1e4 != magnitude || (magnitude < FOUR_PLACES_FROM && near != 0))
        return write_long(value, text);
    *text = '-';
    char *at = put_ten_thousandths(near, text + (signbit(value) != 0));
    /* "-0" would lose its sign in every reader that takes it for an integer. */
    if (near == 0) {
        memcpy(at, ".0", 2);
        at += 2;
    }
    return (size_t)(at - text);
}

size_t number_write_whole(uint64_t value, char *text)
{
    if (value < 100) {
        const size_t count = value < 10 ? 1 : 2;
        memcpy(text, PAIRS + 2 * value + (2 - count), 2);
        return count;
    }
    uint64_t unit = 1;
    for (int i = 0; i < 2 && value / unit >= EIGHT_DIGITS; i++)
        unit *= EIGHT_DIGITS;
    char *at = put_whole((uint32_t)(value / unit), text);
    for (; unit > 1; at += 8) {
        unit /= EIGHT_DIGITS;
        put_eight((uint32_t)(value / unit % EIGHT_DIGITS), at);
    }
    return (size_t)(at - text);
}

static bool is_digit(char character)
{
    return (unsigned)(character - '0') < 10;
}

/* The number of digits among eight bytes, up to the first byte that is none. After the exclusive or
 * with '0' only digits stay below 0x80 both with and without 0x76 added. */
static int digits_in(uint64_t word)
{
    const uint64_t values = word ^ '0' * BYTES;
    const uint64_t others = (values | (values + 0x76 * BYTES)) & 0x80 * BYTES;
    return others == 0 ? 8 : __builtin_ctzll(others) / 8;
}

/* The number that eight digits spell, joined by pairs, by fours and as a whole. */
static uint64_t eight_digits(uint64_t word)
{
    word = (word & 0x0f * BYTES) * (1 + (10 << 8)) >> 8;
    word = (word & UINT64_C(0x00ff00ff00ff00ff)) * (1 + (100 << 16)) >> 16;
    return (word & UINT64_C(0x0000ffff0000ffff)) * (1 + (UINT64_C(10000) << 32)) >> 32;
}

/* The quotient of digits * 2^63 and 5^places, shifted up to 64 bits; a remainder sets its last bit.
 * The estimate is off by at most one. */
static uint64_t quotient_of(uint64_t digits, uint64_t divisor, uint64_t inverse)
{
    const uint64_t high = digits >> 1, low = digits << 63;
    const wide estimate = (wide)inverse * high + ((wide)high << 64 | low);
    uint64_t quotient = (uint64_t)(estimate >> 64) + 1, rest = low - quotient * divisor;
    if (rest > (uint64_t)estimate) {
        quotient--;
        rest += divisor;
    }
    if (rest >= divisor) {
        quotient++;
        rest -= divisor;
    }
    return quotient | (rest != 0);
}

/* Appends the digits at this place, at most eight, to a number; returns how many. */
static inline int take_eight(const char *at, uint64_t *digits)
{
    const uint64_t word = text_word(at);
    /* half of the shift that leaves just these digits */
    const int count = digits_in(word), half = 4 * (8 - count);
    *digits = *digits * WHOLE_TENS[count] + eight_digits(word << half << half);
    return count;
}

/* The end of the number; NULL if an exponent follows. */
static inline const char *finish(const char *begin, const char *end, double size, double *value)
{
    if ((*end | 0x20) == 'e')
        return NULL;
    *value = *begin == '-' ? -size : size;
    return end;
}

/* Reads on behind the first eight digits of the fraction. Kept out of number_take, which would
 * otherwise save registers for every number. */
__attribute__((noinline)) static const char *take_long(const char *begin, const char *fraction,
                                                       uint64_t digits, double *value)
{
    const char *const whole = begin + (*begin == '-'), *at = fraction + 8;
    int count = 8;
    for (; count == 8 && at - fraction < NUMBER_DIGITS; at += count)
        count = take_eight(at, &digits);
    if (at - whole - 1 - (*whole == '0') > NUMBER_DIGITS)
        return NULL;
    return finish(begin, at, number_of_digits(digits, (int)(at - fraction)), value);
}

/* Reads from a copy with zeros behind it, where fewer than NUMBER_ROOM bytes are left. */
__attribute__((noinline)) static const char *take_last(const char *begin, const char *end,
                                                       double *value)
{
    char copy[2 * NUMBER_ROOM] = {0};
    memcpy(copy, begin, (size_t)(end - begin));
    const char *after = number_take(copy, copy + sizeof copy, value);
    return after == NULL ? NULL : begin + (after - copy);
}

/* digits is greater than 0. The quotient has 63 bits or 64. */
static inline double quotient_by_tens(uint64_t digits, int places)
{
    const int up = __builtin_clzll(digits), side = __builtin_clzll(decimal_fives[places]);
    const uint64_t quotient =
        quotient_of(digits << up, FIVES[places].divisor, FIVES[places].inverse);
    const uint64_t bits = (uint64_t)(1023 + side - up - 63 - places) << MANTISSA_BITS;
    double scale;
    memcpy(&scale, &bits, sizeof scale);
    return (double)quotient * scale;
}

/* Both are exact, so that only the division rounds. */
static bool fits_double(uint64_t digits)
{
    return digits >> (MANTISSA_BITS + 1) == 0;
}

double number_of_digits(uint64_t digits, int places)
{
    return fits_double(digits) ? (double)(int64_t)digits / TENS[places]
                               : quotient_by_tens(digits, places);
}

const char *number_take(const char *begin, const char *end, double *value)
{
    if (end - begin < NUMBER_ROOM)
        return take_last(begin, end, value);
    const char *at = begin + (*begin == '-');
    if (!is_digit(*at))
        return NULL;
    uint64_t digits = (uint64_t)(*at++ - '0');
    for (; is_digit(*at); at++) {
        if (digits == 0 || digits > WHOLE_MOST)
            return NULL;
        digits = 10 * digits + (uint64_t)(*at - '0');
    }
    int places = 0;
    if (*at == '.') {
        places = take_eight(++at, &digits);
        if (places == 8)
            return take_long(begin, at, digits, value);
        if (places == 0)
            return NULL;
        at += places;
    }
    return finish(begin, at, (double)(int64_t)digits / TENS[places], value);
}

/* The end of the digits from here on, which are appended to a number; it wraps if there are more
 * than NUMBER_DIGITS. */
static const char *append_digits(const char *at, const char *end, uint64_t *digits)
{
    while (end - at >= 8) {
        const int count = take_eight(at, digits);
        at += count;
        if (count < 8)
            return at;
    }
    for (; at < end && is_digit(*at); at++)
        *digits = 10 * *digits + (uint64_t)(*at - '0');
    return at;
}

/* Adds the exponent that begins behind the "e", if there is one up to the end. */
static bool add_exponent(const char *at, const char *end, int64_t *exponent)
{
    const int64_t enough = INT64_MAX / 100; /* longer than any text in front of it */
    const bool negative = at < end && *at == '-';
    at += at < end && (*at == '-' || *at == '+');
    const char *const first = at;
    int64_t size = 0;
    for (; at < end && is_digit(*at); at++)
        size = size < enough ? 10 * size + (*at - '0') : size;
    *exponent += negative ? -size : size;
    return at == end && at > first;
}

/* The number of digits in [begin, end), where a point may stand, from the first that is not 0. */
static ptrdiff_t digits_that_count(const char *begin, const char *end)
{
    const char *first = begin;
    while (first < end && (*first == '0' || *first == '.'))
        first++;
    const char *const point = memchr(first, '.', (size_t)(end - first));
    return end - first - (point != NULL);
}

/* The double nearest to digits * 10^exponent, if one product or quotient gives it. */
static bool nearest_at_once(uint64_t digits, int64_t exponent, double *value)
{
    if (fits_double(digits) && exponent >= -MOST_TENS && exponent <= 0)
        *value = (double)(int64_t)digits / TENS[-exponent];
    else if (fits_double(digits) && exponent > 0 && exponent <= MOST_TENS)
        *value = (double)(int64_t)digits * TENS[exponent];
    else if (!fits_double(digits) && exponent >= -DECIMAL_FIVES && exponent <= 0)
        *value = quotient_by_tens(digits, (int)-exponent);
    else
        return false;
    return true;
}

bool number_read(const char *begin, const char *end, double *value)
{
    const char *const whole = begin + (begin < end && *begin == '-');
    uint64_t digits = 0;
    const char *at = append_digits(whole, end, &digits);
    const char *const point = at;
    if (at < end && *at == '.')
        at = append_digits(at + 1, end, &digits);
    const char *const last = at;
    const int64_t places = last > point ? last - point - 1 : 0;
    int64_t exponent = -places;
    if (point - whole + places == 0)
        return false;
    if (at < end && (*at == 'e' || *at == 'E') ? !add_exponent(at + 1, end, &exponent) : at != end)
        return false;
    const bool long_text =
        last - whole > NUMBER_DIGITS && digits_that_count(whole, last) > NUMBER_DIGITS;
    if (long_text || !nearest_at_once(digits, exponent, value))
        *value = decimal_nearest(whole, last, exponent);
    if (*begin == '-')
        *value = -*value;
    return isfinite(*value);
}
