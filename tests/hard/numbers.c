/* Doubles as text, of any size, against exact decimals: hard case 54. */
#include "hard.h"

#include "base/number.h"

enum {
    PRECISION = 64,
    DECIMAL_PRECISION = 2000,
    MOST_DIGITS = 17,
    /* A decimal midway between two doubles has 767 digits at most. */
    MIDWAY_DIGITS = 780,
    TEXT_SIZE = 1000,
    LARGEST_FIELD = 2046
};

/* Bits of a finite double greater than 0: powers of two first, then any, and some with few bits. */
static uint64_t point_bits(uint64_t *random, int i)
{
    if (i <= LARGEST_FIELD)
        return i == 0 ? 1 : (uint64_t)i << 52;
    uint64_t field = sample_bits(random) % (LARGEST_FIELD + 1);
    uint64_t fraction = sample_word(random) >> 12;
    if (i % 3 == 0)
        fraction &= UINT64_MAX << sample_bits(random) % 52;
    return field << 52 | fraction | (field == 0);
}

/* True if a decimal lies between the midpoints to both neighbours, or on one and the mantissa is
 * even. This is what reading back to a double means. */
static bool reads_back(const mpfr_t decimal, uint64_t bits)
{
    MPFR_DECL_INIT(midpoint, PRECISION);
    const double value = sample_from_bits(bits);
    const bool last = bits == ((uint64_t)LARGEST_FIELD << 52 | UINT64_MAX >> 12);
    mpfr_set_d(midpoint, sample_from_bits(bits - 1), MPFR_RNDN);
    mpfr_add_d(midpoint, midpoint, value, MPFR_RNDN);
    mpfr_div_2ui(midpoint, midpoint, 1, MPFR_RNDN);
    const int below = mpfr_cmp(decimal, midpoint);
    mpfr_set_d(midpoint, last ? value : sample_from_bits(bits + 1), MPFR_RNDN);
    mpfr_add_d(midpoint, midpoint, value, MPFR_RNDN);
    mpfr_div_2ui(midpoint, midpoint, 1, MPFR_RNDN);
    const int above = last ? -1 : mpfr_cmp(decimal, midpoint);
    return bits % 2 == 0 ? below >= 0 && above <= 0 : below > 0 && above < 0;
}

/* The decimal of so many digits next to a value on one side, in enough bits for comparisons. */
static void set_decimal(mpfr_t decimal, double value, size_t digits, mpfr_rnd_t side)
{
    MPFR_DECL_INIT(exact, PRECISION);
    mpfr_set_d(exact, value, MPFR_RNDN);
    mpfr_exp_t exponent;
    char mantissa[64], text[96];
    mpfr_get_str(mantissa, &exponent, 10, digits, exact, side);
    snprintf(text, sizeof text, "0.%se%ld", mantissa, (long)exponent);
    mpfr_set_str(decimal, text, 10, MPFR_RNDN);
}

/* The nearest of the decimals that read back and have as few digits as any; of two, the even one.
 */
static void set_shortest(mpfr_t nearest, uint64_t bits)
{
    const double value = sample_from_bits(bits);
    bool below = false, above = false;
    MPFR_DECL_INIT(lower, DECIMAL_PRECISION);
    for (size_t digits = 1; !below && !above; digits++) {
        assert_in_range(digits, 1, MOST_DIGITS);
        set_decimal(lower, value, digits, MPFR_RNDD);
        set_decimal(nearest, value, digits, MPFR_RNDU);
        below = reads_back(lower, bits);
        above = reads_back(nearest, bits);
        if (below && above)
            set_decimal(nearest, value, digits, MPFR_RNDN);
    }
    if (!above)
        mpfr_set(nearest, lower, MPFR_RNDN);
}

/* Large whole numbers are written with all digits where that is not longer. */
static bool written_as_nearest(double value, const mpfr_t nearest)
{
    char text[NUMBER_SIZE + 1];
    text[number_write(value, text)] = '\0';
    MPFR_DECL_INIT(written, DECIMAL_PRECISION);
    mpfr_set_str(written, text, 10, MPFR_RNDN);
    const bool all_digits = strpbrk(text, ".e") == NULL && mpfr_cmp_d(written, value) == 0;
    const bool same = all_digits || mpfr_equal_p(written, nearest);
    return same;
}

TEST(the_shortest_decimals_of_all_sizes_are_written)
{
    uint64_t random = 54;
    const int points = hard_points(30000);
    double naive = 0, ours = 0;
    MPFR_DECL_INIT(nearest, DECIMAL_PRECISION);
    MPFR_DECL_INIT(plain, DECIMAL_PRECISION);
    for (int i = 0; i < points; i++) {
        const uint64_t bits = point_bits(&random, i);
        const double value = sample_from_bits(bits);
        char text[64];
        snprintf(text, sizeof text, "%.17g", value);
        mpfr_set_str(plain, text, 10, MPFR_RNDN);
        set_shortest(nearest, bits);
        naive += !mpfr_equal_p(plain, nearest);
        ours += !written_as_nearest(value, nearest);
    }
    hard_case("54", "decimals not the shortest and nearest (naive: %.17g)", "wrong", naive, ours,
              0);
}

/* The text of the decimal midway between a double and the next, with more behind it. */
static void put_midway(uint64_t bits, const char *more, char *text)
{
    MPFR_DECL_INIT(midpoint, PRECISION);
    mpfr_set_d(midpoint, sample_from_bits(bits), MPFR_RNDN);
    mpfr_add_d(midpoint, midpoint, sample_from_bits(bits + 1), MPFR_RNDN);
    mpfr_div_2ui(midpoint, midpoint, 1, MPFR_RNDN);
    mpfr_exp_t exponent;
    char digits[TEXT_SIZE];
    mpfr_get_str(digits, &exponent, 10, MIDWAY_DIGITS, midpoint, MPFR_RNDN);
    size_t count = strlen(digits);
    while (digits[count - 1] == '0')
        count--;
    snprintf(text, TEXT_SIZE, "%.*s%se%ld", (int)count, digits, more,
             (long)exponent - (long)count - (long)strlen(more));
}

/* The last digit of the text before its exponent is made smaller by one, and nines follow. */
static void put_less(uint64_t bits, char *text)
{
    put_midway(bits, "99999", text);
    strchr(text, 'e')[-6]--;
}

static bool reads_as(const char *text, uint64_t bits)
{
    const double expected = sample_from_bits(bits);
    double value;
    return number_read(text, text + strlen(text), &value) &&
           memcmp(&value, &expected, sizeof value) == 0;
}

/* What 19 digits of the text read as. */
static bool cut_reads_as(const char *text, uint64_t bits)
{
    const size_t count = strcspn(text, "e");
    const size_t kept = count < 19 ? count : 19;
    char cut[64];
    snprintf(cut, sizeof cut, "%.*se%ld", (int)kept, text,
             atol(text + count + 1) + (long)(count - kept));
    return reads_as(cut, bits);
}

TEST(decimals_midway_between_doubles_are_read_exactly)
{
    uint64_t random = 55;
    const int points = hard_points(30000);
    double naive = 0, ours = 0;
    for (int i = 1; i <= points; i++) {
        const uint64_t bits = point_bits(&random, i), even = bits + bits % 2;
        if (bits + 1 >= (uint64_t)(LARGEST_FIELD + 1) << 52)
            continue;
        char text[TEXT_SIZE];
        put_midway(bits, "", text);
        ours += !reads_as(text, even);
        naive += !cut_reads_as(text, even);
        put_midway(bits, "000000000000000000000000000001", text);
        ours += !reads_as(text, bits + 1);
        naive += !cut_reads_as(text, bits + 1);
        put_less(bits, text);
        ours += !reads_as(text, bits);
        naive += !cut_reads_as(text, bits);
    }
    hard_case("54", "midway decimals and one digit off (naive: 19 digits)", "wrong", naive, ours,
              0);
}
