#include "base/decimal.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

__extension__ typedef unsigned __int128 wide;

enum {
    WORD_BITS = 64,
    MANTISSA_BITS = 52,
    EXPONENT_BIAS = 1075,
    LARGEST_FIELD = 2046,
    /* Bits of a fraction: one for a half and one for what is less. */
    LEAST_FRACTION = 2,
    TOP_BITS = 62,
    /* Decimals midway between two doubles have 767 digits at most. */
    MOST_DIGITS = 800,
    /* Numbers are too large or too small if this many digits stand in front of the point. */
    HIGHEST = 310,
    LOWEST = -330,
    /* All digits have 2,658 bits, and 5^1130, by which those behind 330 zeros are divided, 2,624.
     */
    WORDS = 96
};

/* The largest power of ten in a word. */
#define LARGEST_UNIT UINT64_C(10000000000000000000)

const uint64_t decimal_fives[DECIMAL_FIVES + 1] = {
    UINT64_C(1),
    UINT64_C(5),
    UINT64_C(25),
    UINT64_C(125),
    UINT64_C(625),
    UINT64_C(3125),
    UINT64_C(15625),
    UINT64_C(78125),
    UINT64_C(390625),
    UINT64_C(1953125),
    UINT64_C(9765625),
    UINT64_C(48828125),
    UINT64_C(244140625),
    UINT64_C(1220703125),
    UINT64_C(6103515625),
    UINT64_C(30517578125),
    UINT64_C(152587890625),
    UINT64_C(762939453125),
    UINT64_C(3814697265625),
    UINT64_C(19073486328125),
    UINT64_C(95367431640625),
    UINT64_C(476837158203125),
    UINT64_C(2384185791015625),
    UINT64_C(11920928955078125),
    UINT64_C(59604644775390625),
    UINT64_C(298023223876953125),
    UINT64_C(1490116119384765625),
    UINT64_C(7450580596923828125),
};

/* A whole number, the lowest word first and the highest not 0. The exact number may be greater by
 * less than 1: then more is set. */
struct whole {
    uint64_t words[WORDS];
    int count;
    bool more;
};

static void set(struct whole *whole, uint64_t value)
{
    whole->words[0] = value;
    whole->count = value != 0;
    whole->more = false;
}

static void multiply(struct whole *whole, uint64_t factor, uint64_t summand)
{
    uint64_t carry = summand;
    for (int i = 0; i < whole->count; i++) {
        const wide product = (wide)whole->words[i] * factor + carry;
        whole->words[i] = (uint64_t)product;
        carry = (uint64_t)(product >> WORD_BITS);
    }
    if (carry != 0)
        whole->words[whole->count++] = carry;
}

static void divide(struct whole *whole, uint64_t divisor)
{
    uint64_t rest = 0;
    for (int i = whole->count - 1; i >= 0; i--) {
        const wide part = (wide)rest << WORD_BITS | whole->words[i];
        const uint64_t quotient = (uint64_t)(part / divisor);
        rest = (uint64_t)part - quotient * divisor;
        whole->words[i] = quotient;
    }
    whole->more = whole->more || rest != 0;
    if (whole->count > 0 && whole->words[whole->count - 1] == 0)
        whole->count--;
}

/* Multiplies by a power of 2^64. */
static void shift_up(struct whole *whole, int words)
{
    for (int i = whole->count - 1; i >= 0; i--)
        whole->words[i + words] = whole->words[i];
    for (int i = 0; i < words; i++)
        whole->words[i] = 0;
    whole->count += words;
}

/* Divides by a power of 2^64. */
static void shift_down(struct whole *whole, int words)
{
    const int dropped = words < whole->count ? words : whole->count;
    for (int i = 0; i < dropped; i++)
        whole->more = whole->more || whole->words[i] != 0;
    whole->count -= dropped;
    for (int i = 0; i < whole->count; i++)
        whole->words[i] = whole->words[i + dropped];
}

/* Multiplies by 2^(64 * words) * 5^fives, in an order that loses no bit before the last step. */
static void scale(struct whole *whole, int words, int fives)
{
    for (; fives >= DECIMAL_FIVES; fives -= DECIMAL_FIVES)
        multiply(whole, decimal_fives[DECIMAL_FIVES], 0);
    if (fives > 0)
        multiply(whole, decimal_fives[fives], 0);
    if (words > 0)
        shift_up(whole, words);
    else
        shift_down(whole, -words);
    for (; fives <= -DECIMAL_FIVES; fives += DECIMAL_FIVES)
        divide(whole, decimal_fives[DECIMAL_FIVES]);
    if (fives < 0)
        divide(whole, decimal_fives[-fives]);
}

/* value * 2^(64 * words) * 5^fives, with its last bit set if the exact number is greater. */
static wide scaled(uint64_t value, int words, int fives)
{
    struct whole whole;
    set(&whole, value);
    scale(&whole, words, fives);
    const wide low = whole.count > 0 ? whole.words[0] : 0;
    const wide high = whole.count > 1 ? whole.words[1] : 0;
    return high << WORD_BITS | low | whole.more;
}

/* The multiple of ten in [low, high] or, as there is none, the whole number nearest to value there.
 * All three have a fraction of so many bits. */
static uint64_t whole_between(wide low, wide value, wide high, int fraction)
{
    const uint64_t tens = (uint64_t)(high >> fraction) / 10 * 10;
    if ((wide)tens << fraction >= low)
        return tens;
    const uint64_t below = (uint64_t)(value >> fraction);
    const wide half = (wide)1 << (fraction - 1), rest = value - ((wide)below << fraction);
    const uint64_t nearest = below + (rest > half || (rest == half && below % 2 != 0));
    return (wide)nearest << fraction < low ? nearest + 1 : nearest;
}

/* What reads back to a double lies between the midpoints to its neighbours, which read back to it
 * if its mantissa is even. places is the least number with a multiple of 10^-places in every such
 * interval: fewer than ten lie there, and at most one multiple of ten, which is then shorter.
 * Kept out of its callers, which rarely need it and would otherwise save registers for each number.
 */
__attribute__((noinline)) struct decimal decimal_shortest(uint64_t bits)
{
    assert(bits > 0 && bits >> MANTISSA_BITS < 0x7ff);
    const int field = (int)(bits >> MANTISSA_BITS);
    const uint64_t one = UINT64_C(1) << MANTISSA_BITS, fraction = bits & (one - 1);
    const uint64_t mantissa = field > 0 ? one | fraction : fraction;
    const int twos = (field > 0 ? field : 1) - EXPONENT_BIAS;
    /* Below a power of two the next double is nearer than above it: the interval is 3/4 as wide. */
    const bool narrow = fraction == 0 && field > 1;
    const double log10_2 = 0.3010299956639812, log10_4_3 = 0.12493873660829995;
    const int places = -(int)floor(twos * log10_2 - (narrow ? log10_4_3 : 0));
    /* Quarters of the mantissa's last place, times 10^places, times a power of 2^64. */
    const int left = twos - 2 + places;
    const int words = (int)ceil((double)(left + LEAST_FRACTION) / WORD_BITS);
    const wide low = scaled(4 * mantissa - (narrow ? 1 : 2), words, places);
    const wide value = scaled(4 * mantissa, words, places);
    const wide high = scaled(4 * mantissa + 2, words, places);
    const unsigned odd = mantissa % 2 != 0;
    const uint64_t digits = whole_between(low + odd, value, high - odd, WORD_BITS * words - left);
    return (struct decimal){digits, places};
}

/* The double nearest to top * 2^exponent; top has TOP_BITS, and its last bit is set if the exact
 * number is greater. */
static double nearest_double(uint64_t top, int exponent)
{
    int drop = TOP_BITS - MANTISSA_BITS - 1, field = exponent + drop + EXPONENT_BIAS;
    if (field > LARGEST_FIELD)
        return (double)INFINITY;
    if (field < 1) { /* subnormal numbers share one exponent */
        drop += 1 - field;
        field = 1;
    }
    if (drop > TOP_BITS)
        return 0;
    const uint64_t half = UINT64_C(1) << (drop - 1), rest = top & (2 * half - 1);
    uint64_t mantissa = top >> drop;
    mantissa += rest > half || (rest == half && mantissa % 2 != 0);
    /* The leading bit of the mantissa, and a carry out of it, count up the exponent. */
    const uint64_t bits = ((uint64_t)(field - 1) << MANTISSA_BITS) + mantissa;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The leading TOP_BITS of a number other than 0, the last of them set if the exact number is
 * greater. Adds to exponent what a unit of theirs is. */
static uint64_t top_of(struct whole *whole, int *exponent)
{
    const int up = __builtin_clzll(whole->words[whole->count - 1]);
    const int drop = 2 * WORD_BITS - TOP_BITS - up;
    *exponent += (whole->count - 2) * WORD_BITS + drop;
    if (whole->count == 1)
        shift_up(whole, 1);
    else
        shift_down(whole, whole->count - 2);
    const wide both = (wide)whole->words[1] << WORD_BITS | whole->words[0];
    const uint64_t top = (uint64_t)(both >> drop);
    return top | (whole->more || (wide)top << drop != both);
}

/* Reads digits from the first that is not 0 on; returns how many, with those it leaves out. Zeros
 * in their place would be on the same side of any midpoint between two doubles, or on it. */
static int64_t read_digits(const char *begin, const char *end, struct whole *whole)
{
    int64_t count = 0;
    uint64_t group = 0, unit = 1; /* some digits, and the power of ten that makes room for them */
    for (const char *at = begin; at < end; at++) {
        if (*at == '.' || (*at == '0' && count == 0))
            continue;
        if (count++ >= MOST_DIGITS) {
            whole->more = whole->more || *at != '0';
            continue;
        }
        group = 10 * group + (uint64_t)(*at - '0');
        unit *= 10;
        if (unit < LARGEST_UNIT)
            continue;
        multiply(whole, unit, group);
        group = 0;
        unit = 1;
    }
    multiply(whole, unit, group);
    return count;
}

double decimal_nearest(const char *begin, const char *end, int64_t exponent)
{
    struct whole whole = {0};
    set(&whole, 0);
    const int64_t count = read_digits(begin, end, &whole);
    if (count == 0 || count + exponent < LOWEST)
        return 0;
    if (count + exponent > HIGHEST)
        return (double)INFINITY;
    const int tens = (int)(count > MOST_DIGITS ? exponent + count - MOST_DIGITS : exponent);
    /* The quotient by 5^n has TOP_BITS or more: 7 / 3 is greater than log2(5). */
    const int words = tens < 0 ? 1 + (TOP_BITS - tens * 7 / 3) / WORD_BITS : 0;
    scale(&whole, words, tens);
    int twos = tens - WORD_BITS * words;
    const uint64_t top = top_of(&whole, &twos);
    return nearest_double(top, twos);
}
