#include "number.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include <locale.h>
#include <stdlib.h>

namespace {

// From here to there the shortest text is never the one with an exponent.
constexpr double FIXED_FROM = 1e-3, FIXED_TO = 1e5;

enum { MANTISSA_BITS = 52, EXPONENT_BIAS = 1075, DIGITS = 17, EIGHT_DIGITS = 100000000 };

constexpr uint64_t FIVES[] = {1,
                              5,
                              25,
                              125,
                              625,
                              3125,
                              15625,
                              78125,
                              390625,
                              1953125,
                              9765625,
                              48828125,
                              244140625,
                              1220703125,
                              6103515625,
                              30517578125,
                              152587890625,
                              762939453125,
                              3814697265625,
                              19073486328125};

constexpr double TENS[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,
                           1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19};

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

// Of a number below 10^8, and where it ends.
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

// Of value / 10^4, and where it ends.
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

using wide = unsigned __int128;

// Of all decimals that read back to mantissa * 2^-scale the shortest, and of those the nearest, as
// a multiple of 10^-places. Places is the least that puts at least one multiple between the two
// midpoints to the neighbours, so less than ten lie there, and at most one multiple of ten, which
// is then shorter. The product is exact in 128 bits, what lies beside it in 64. Ties go to the even
// decimal.
uint64_t shortest_multiple(uint64_t mantissa, int scale, int places)
{
    const wide exact = wide(mantissa) * FIVES[places]; // in units of 2^-shift
    const int shift = scale - places;
    const uint64_t below = uint64_t(exact >> 64) << (64 - shift) | uint64_t(exact) >> shift;
    const uint64_t half = uint64_t(1) << (shift - 1), rest = uint64_t(exact) & (2 * half - 1);
    // To the midpoints, in half units; those of an odd mantissa read back to the neighbours.
    const uint64_t reach = FIVES[places] - (mantissa & 1);
    const uint64_t tens = (below + ((2 * rest + reach) >> (shift + 1))) / 10 * 10;
    if (tens > below || (below - tens) * 4 * half + 2 * rest <= reach)
        return tens;
    return below + (rest > half || (rest == half && (below & 1)));
}

// A number that is no whole one, in fixed notation, and where it ends.
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

} // namespace

size_t number_write(double value, char *text)
{
    const double magnitude = std::fabs(value);
    if (!(magnitude >= FIXED_FROM && magnitude < FIXED_TO) && magnitude != 0)
        return size_t(std::to_chars(text, text + NUMBER_SIZE, value).ptr - text);
    char *at = text;
    *at = '-';
    at += std::signbit(value);
    // Two decimals of so few digits are never the same double, so there is no shorter one.
    const uint32_t near = uint32_t(magnitude * 1e4 + 0.5);
    if (near / 1e4 == magnitude) {
        at = put_ten_thousandths(near, at);
        // "-0" would lose its sign in every reader that takes it for an integer.
        if (near == 0 && at > text + 1)
            at = static_cast<char *>(memcpy(at, ".0", 2)) + 2;
        return size_t(at - text);
    }
    uint64_t bits;
    memcpy(&bits, &magnitude, sizeof bits);
    const uint64_t one = uint64_t(1) << MANTISSA_BITS, fraction = bits & (one - 1);
    // Below a power of two the next double is nearer than above it.
    if (fraction == 0)
        return size_t(std::to_chars(text, text + NUMBER_SIZE, value).ptr - text);
    at = put_shortest(one | fraction, EXPONENT_BIAS - int(bits >> MANTISSA_BITS), at);
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
        return double(digits) / TENS[places];
    // The quotient by 5^places to 63 bits or 64, of which the last one says whether there is a rest.
    const int up = __builtin_clzll(digits), side = __builtin_clzll(FIVES[places]);
    const uint64_t divisor = FIVES[places] << side;
    const wide dividend = wide(digits << up) << 63;
    const uint64_t quotient = uint64_t(dividend / divisor);
    const bool rest = wide(quotient) * divisor != dividend;
    const uint64_t power = uint64_t(1023 + side - up - 63 - places) << MANTISSA_BITS;
    double scale;
    memcpy(&scale, &power, sizeof scale);
    return double(quotient | rest) * scale;
}

bool number_read(const char *begin, const char *end, double *value)
{
    auto result = std::from_chars(begin, end, *value);
    if (result.ptr != end)
        return false;
    if (result.ec == std::errc())
        return true;
    // from_chars does not say whether it left the doubles above or below; strtod does, but by the
    // locale of whoever calls.
    locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
    *value = strtod_l(std::string(begin, end).c_str(), nullptr, plain);
    freelocale(plain);
    return std::isfinite(*value);
}
