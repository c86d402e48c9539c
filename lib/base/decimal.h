/* Any double's shortest decimal, any decimal's nearest double. By whole numbers of as many words
 * as it takes, so that nothing is estimated; number.h calls this module only for numbers that are
 * too small, too large or too long for its own 128 bits. */
#pragma once

#include <stdint.h>

/* digits * 10^-places */
struct decimal {
    uint64_t digits;
    int places;
};

/* The shortest decimal that reads back to a double, and the nearest of several; ties go to the
 * even one. The double is greater than 0, finite and given by its bits. There are at most 17
 * digits, and the last of them may be zeros. */
struct decimal decimal_shortest(uint64_t bits);

/* The double nearest to the digits of [begin, end), among which a point may stand and is skipped,
 * times 10^exponent, which is the place of the last digit; ties go to the even one. 0 if it is too
 * small, infinite if it is too large. */
double decimal_nearest(const char *begin, const char *end, int64_t exponent);

/* The powers of five that 64 bits hold. */
enum { DECIMAL_FIVES = 27 };
extern const uint64_t decimal_fives[DECIMAL_FIVES + 1];
