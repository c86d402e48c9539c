/* Numbers as text beside std::to_chars, of which a standard demands the same: the shortest decimal
 * that reads back, and the nearest of several. Minus zero, which it writes as "-0", is left out,
 * and all where make finds no C++ compiler. CASES is how many doubles are written, in place of
 * 10^6. */
#include "check.h"

#include "base/number.h"
#include "sample.h"
#include "speed/digits.h"

/* The oracle is linked only if it could be compiled. */
char *digits_write(double value, char *at) __attribute__((weak));

enum { TEXT_SIZE = 256 };

static void compare_written(double value)
{
    if (!isfinite(value) || value == 0)
        return;
    char ours[NUMBER_SIZE + 1] = "", theirs[TEXT_SIZE] = "";
    ours[number_write(value, ours)] = '\0';
    *digits_write(value, theirs) = '\0';
    if (strcmp(ours, theirs) != 0)
        fail_msg("%.17g is %s, expected %s", value, ours, theirs);
}

/* The double of these bits, its neighbours and their negatives. */
static void compare_around(uint64_t bits)
{
    for (uint64_t near = bits - (bits > 1); near <= bits + 1; near++) {
        compare_written(sample_from_bits(near));
        compare_written(-sample_from_bits(near));
    }
}

TEST(powers_of_two_and_ten_and_their_neighbours_are_written_alike)
{
    if (digits_write == NULL)
        skip_because("there is no C++ compiler");
    for (uint64_t bits = 1; bits < 3000; bits++)
        compare_around(bits);
    for (uint64_t bit = 0; bit < 52; bit++)
        compare_around(UINT64_C(1) << bit);
    for (uint64_t field = 1; field < 2047; field++)
        compare_around(field << 52);
    for (int exponent = -323; exponent <= 308; exponent++)
        for (int digits = 1; digits < 100; digits++) {
            char text[TEXT_SIZE];
            snprintf(text, sizeof text, "%de%d", digits, exponent);
            compare_around(sample_to_bits(strtod(text, NULL)));
        }
}

/* A double of one of many kinds. */
static double number_of_kind(uint64_t *random, int kind)
{
    uint64_t word = sample_word(random);
    double digits = (double)(word >> word % 64),
           power = pow(10, (double)(sample_word(random) % 40));
    switch (kind) {
    case 0: /* any double */
        return sample_from_bits(word);
    case 1: /* few bits */
        return sample_from_bits(word & UINT64_MAX << sample_word(random) % 52);
    case 2: /* subnormal */
        return sample_from_bits(word >> (12 + sample_word(random) % 52));
    case 3: /* whole, and halves and quarters of whole numbers */
        return ldexp(digits, -(int)(sample_word(random) % 4));
    case 4: /* few digits */
        return (double)(word % 1000000) / power;
    case 5: /* many digits */
        return digits / power;
    case 6: /* whole and beyond 2^53, where decimals end with zeros */
        return (double)(word >> sample_word(random) % 12) *
               (double)(1 + sample_word(random) % 5000);
    default: /* as coordinates and amplitudes are */
        return sample_between(random, -300, 300) / (double)(1 + sample_word(random) % 1000);
    }
}

TEST(doubles_of_every_kind_are_written_alike)
{
    if (digits_write == NULL)
        skip_because("there is no C++ compiler");
    const int64_t count = (int64_t)check_cases(1e6);
    uint64_t random = 1;
    for (int64_t i = 0; i < count; i++)
        compare_written(number_of_kind(&random, (int)(i % 8)));
}
