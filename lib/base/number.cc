#include "base/number.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include <locale.h>
#include <stdlib.h>

extern "C" {
#include "base/text.h"
}

namespace {

// In this range fixed notation is never longer than an exponent.
constexpr double FIXED_FROM = 1e-3, FIXED_TO = 1e5;

enum { MANTISSA_BITS = 52, EXPONENT_BIAS = 1075, DIGITS = 17, EIGHT_DIGITS = 100000000 };

using wide = unsigned __int128;

constexpr double TENS[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,
                           1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19};

constexpr uint64_t WHOLE_TENS[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};

// Up to here one more digit and seven behind the point still fit a double.
constexpr uint64_t WHOLE_MOST = 10000000;

// number_take looks at fewer bytes.
static_assert(NUMBER_ROOM > 1 + 8 + 1 + 8 + NUMBER_DIGITS, "it has room for a sign, a point and all digits");

constexpr uint64_t BYTES = UINT64_C(0x0101010101010101);

// The powers of five; the same shifted up to 64 bits; and 2^128 divided by each of those, less 2^64:
// a product with this inverse replaces the division (N. Moeller and T. Granlund, Improved division
// by invariant integers, 2011).
struct powers_of_five {
    uint64_t power[NUMBER_DIGITS + 1], divisor[NUMBER_DIGITS + 1], inverse[NUMBER_DIGITS + 1];
};

constexpr powers_of_five powers_of_five_table()
{
    powers_of_five five{};
    for (int i = 0; i <= NUMBER_DIGITS; i++) {
        five.power[i] = i == 0 ? 1 : 5 * five.power[i - 1];
        five.divisor[i] = five.power[i];
        while (five.divisor[i] >> 63 == 0)
            five.divisor[i] *= 2;
        five.inverse[i] = uint64_t(~wide(0) / five.divisor[i]);
    }
    return five;
}

constexpr powers_of_five FIVE = powers_of_five_table();

constexpr char PAIRS[] = "0001020304050607080910111213141516171819"
                         "2021222324252627282930313233343536373839"
                         "4041424344454647484950515253545556575859"
                         "6061626364656667686970717273747576777879"
                         "8081828384858687888990919293949596979899";

void put_four(uint32_t value, char *text)
{
    memcpy(text, PAIRS + 2 * (value / 100), 2);
    memcpy(text + 2, PAIRS + 2 * (value % 100), 2);
}

void put_eight(uint32_t value, char *text)
{
    put_four(value / 10000, text);
    put_four(value % 10000, text + 4);
}

char *without_zeros(char *end)
{
    while (end[-1] == '0')
        end--;
    return end;
}

// Writes a number below 10^8; returns where it ends.
char *put_whole(uint32_t value, char *text)
{
    if (value < 10) {
        *text = char('0' + value);
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

// Writes value / 10^4; returns where it ends.
char *put_ten_thousandths(uint32_t value, char *text)
{
    const uint32_t fraction = value % 10000;
    text = put_whole(value / 10000, text);
    if (fraction == 0)
        return text;
    *text = '.';
    put_four(fraction, text + 1);
    return without_zeros(text + 5);
}

// The shortest decimal that reads back to mantissa * 2^-scale, and the nearest of several, as a
// multiple of 10^-places. places is the least number that puts at least one multiple between the
// midpoints to both neighbours. So fewer than ten multiples lie there, and at most one multiple of
// ten, which is then shorter. The product is exact in 128 bits, its fraction in 64. Ties go to the
// even decimal.
uint64_t shortest_multiple(uint64_t mantissa, int scale, int places)
{
    const wide exact = wide(mantissa) * FIVE.power[places]; // in units of 2^-shift
    const int shift = scale - places;
    const uint64_t below = uint64_t(exact >> 64) << (64 - shift) | uint64_t(exact) >> shift;
    const uint64_t half = uint64_t(1) << (shift - 1), rest = uint64_t(exact) & (2 * half - 1);
    // The distance to the midpoints, in half units; the midpoints of an odd mantissa read back to
    // the neighbours.
    const uint64_t reach = FIVE.power[places] - (mantissa & 1);
    const uint64_t tens = (below + ((2 * rest + reach) >> (shift + 1))) / 10 * 10;
    if (tens > below || (below - tens) * 4 * half + 2 * rest <= reach)
        return tens;
    return below + (rest > half || (rest == half && (below & 1)));
}

// Writes a number that is not whole, in fixed notation; returns where it ends.
char *put_shortest(uint64_t mantissa, int scale, char *text)
{
    const int places = 1 + (scale * 1233 >> 12); // 1233 / 4096 is log10(2)
    const uint64_t multiple = shortest_multiple(mantissa, scale, places);
    char digits[2 * DIGITS];
    digits[0] = char('0' + multiple / EIGHT_DIGITS / EIGHT_DIGITS);
    put_eight(uint32_t(multiple / EIGHT_DIGITS % EIGHT_DIGITS), digits + 1);
    put_eight(uint32_t(multiple % EIGHT_DIGITS), digits + 9);
    const char *first = digits + (digits[0] == '0');
    const ptrdiff_t count = without_zeros(digits + DIGITS) - first;
    const ptrdiff_t whole = digits + DIGITS - first - places;
    if (whole > 0) {
        memcpy(text, first, 8);
        text[whole] = '.';
        memcpy(text + whole + 1, first + whole, DIGITS);
        return text + count + 1;
    }
    memcpy(text, "0.00", 4);
    memcpy(text + 2 - whole, first, DIGITS);
    return text + 2 - whole + count;
}

bool is_digit(char character)
{
    return unsigned(character - '0') < 10;
}

// The number of digits among eight bytes, up to the first byte that is none. After the exclusive or
// with '0' only digits stay below 0x80 both with and without 0x76 added.
int digits_in(uint64_t word)
{
    const uint64_t values = word ^ '0' * BYTES;
    const uint64_t others = (values | (values + 0x76 * BYTES)) & 0x80 * BYTES;
    return others == 0 ? 8 : __builtin_ctzll(others) / 8;
}

// The number that eight digits spell, joined by pairs, by fours and as a whole.
uint64_t eight_digits(uint64_t word)
{
    word = (word & 0x0f * BYTES) * (1 + (10 << 8)) >> 8;
    word = (word & UINT64_C(0x00ff00ff00ff00ff)) * (1 + (100 << 16)) >> 16;
    return (word & UINT64_C(0x0000ffff0000ffff)) * (1 + (UINT64_C(10000) << 32)) >> 32;
}

// The quotient of digits * 2^63 and the shifted 5^places; a remainder sets its last bit. The
// estimate is off by at most one.
uint64_t quotient_of(uint64_t digits, int places)
{
    const uint64_t divisor = FIVE.divisor[places], inverse = FIVE.inverse[places];
    const uint64_t high = digits >> 1, low = digits << 63;
    const wide estimate = wide(inverse) * high + (wide(high) << 64 | low);
    uint64_t quotient = uint64_t(estimate >> 64) + 1, rest = low - quotient * divisor;
    if (rest > uint64_t(estimate)) {
        quotient--;
        rest += divisor;
    }
    if (rest >= divisor) {
        quotient++;
        rest -= divisor;
    }
    return quotient | (rest != 0);
}

// Appends the digits at this place, at most eight, to a number; returns how many.
inline int take_eight(const char *at, uint64_t *digits)
{
    const uint64_t word = text_word(at);
    const int count = digits_in(word), half = 4 * (8 - count); // half of the shift that leaves just
                                                               // these digits
    *digits = *digits * WHOLE_TENS[count] + eight_digits(word << half << half);
    return count;
}

// The end of the number; nullptr if an exponent follows.
inline const char *finish(const char *begin, const char *end, double size, double *value)
{
    if ((*end | 0x20) == 'e')
        return nullptr;
    *value = *begin == '-' ? -size : size;
    return end;
}

// Reads on behind the first eight digits of the fraction. Kept out of number_take, which would
// otherwise save registers for every number.
[[gnu::noinline]] const char *take_long(const char *begin, const char *fraction, uint64_t digits,
                                        double *value)
{
    const char *const whole = begin + (*begin == '-'), *at = fraction + 8;
    int count = 8;
    for (; count == 8 && at - fraction < NUMBER_DIGITS; at += count)
        count = take_eight(at, &digits);
    if (at - whole - 1 - (*whole == '0') > NUMBER_DIGITS)
        return nullptr;
    return finish(begin, at, number_of_digits(digits, int(at - fraction)), value);
}

// Reads from a copy with zeros behind it, where fewer than NUMBER_ROOM bytes are left.
[[gnu::noinline]] const char *take_last(const char *begin, const char *end, double *value)
{
    char copy[2 * NUMBER_ROOM] = {0};
    memcpy(copy, begin, size_t(end - begin));
    const char *after = number_take(copy, copy + sizeof copy, value);
    return after == nullptr ? nullptr : begin + (after - copy);
}

// Writes as many digits as it takes. Kept out of number_write, which would otherwise save registers
// for every number.
[[gnu::noinline]] size_t write_long(double value, char *text)
{
    const double magnitude = std::fabs(value);
    uint64_t bits;
    memcpy(&bits, &magnitude, sizeof bits);
    const uint64_t one = uint64_t(1) << MANTISSA_BITS, fraction = bits & (one - 1);
    // Below a power of two the next double is nearer than above it.
    if (!(magnitude >= FIXED_FROM && magnitude < FIXED_TO) || fraction == 0)
        return size_t(std::to_chars(text, text + NUMBER_SIZE, value).ptr - text);
    *text = '-';
    const char *end = put_shortest(one | fraction, EXPONENT_BIAS - int(bits >> MANTISSA_BITS),
                                   text + std::signbit(value));
    return size_t(end - text);
}

} // namespace

size_t number_write(double value, char *text)
{
    const double magnitude = std::fabs(value);
    // Two decimals of so few digits are never the same double, so no decimal is shorter.
    const uint32_t near = magnitude < FIXED_TO ? uint32_t(magnitude * 1e4 + 0.5) : 0;
    if (near / 1e4 != magnitude || (magnitude < FIXED_FROM && near != 0))
        return write_long(value, text);
    *text = '-';
    char *at = put_ten_thousandths(near, text + std::signbit(value));
    // "-0" would lose its sign in every reader that takes it for an integer.
    if (near == 0 && at > text + 1)
        at = static_cast<char *>(memcpy(at, ".0", 2)) + 2;
    return size_t(at - text);
}

size_t number_write_whole(uint64_t value, char *text)
{
    return size_t(std::to_chars(text, text + NUMBER_SIZE, value).ptr - text);
}

double number_of_digits(uint64_t digits, int places)
{
    // Both are exact, so that only the division rounds.
    if (digits >> (MANTISSA_BITS + 1) == 0)
        return double(int64_t(digits)) / TENS[places];
    // The quotient has 63 bits or 64.
    const int up = __builtin_clzll(digits), side = __builtin_clzll(FIVE.power[places]);
    const uint64_t quotient = quotient_of(digits << up, places);
    const uint64_t power = uint64_t(1023 + side - up - 63 - places) << MANTISSA_BITS;
    double scale;
    memcpy(&scale, &power, sizeof scale);
    return double(quotient) * scale;
}

const char *number_take(const char *begin, const char *end, double *value)
{
    if (end - begin < NUMBER_ROOM)
        return take_last(begin, end, value);
    const char *at = begin + (*begin == '-');
    if (!is_digit(*at))
        return nullptr;
    uint64_t digits = uint64_t(*at++ - '0');
    for (; is_digit(*at); at++) {
        if (digits == 0 || digits > WHOLE_MOST)
            return nullptr;
        digits = 10 * digits + uint64_t(*at - '0');
    }
    int places = 0;
    if (*at == '.') {
        places = take_eight(++at, &digits);
        if (places == 8)
            return take_long(begin, at, digits, value);
        if (places == 0)
            return nullptr;
        at += places;
    }
    return finish(begin, at, double(int64_t(digits)) / TENS[places], value);
}

bool number_read(const char *begin, const char *end, double *value)
{
    auto result = std::from_chars(begin, end, *value);
    if (result.ptr != end)
        return false;
    if (result.ec == std::errc())
        return true;
    // from_chars does not say whether the number is too large or too small; strtod does, but
    // depends on the caller's locale.
    locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
    *value = strtod_l(std::string(begin, end).c_str(), nullptr, plain);
    freelocale(plain);
    return std::isfinite(*value);
}
