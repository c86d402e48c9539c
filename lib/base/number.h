/* Doubles and whole numbers as text, and back. A double is written as the shortest decimal that
 * reads back to the same double, and a decimal is read as the nearest double. C's own printf and
 * strtod are ten times slower and depend on the locale. Most numbers of a frame follow from one
 * exact product or quotient of 128 bits; base/decimal.h has all others. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* The bits of a double, which tell 0 from -0. */
static inline uint64_t number_bits(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

enum { NUMBER_SIZE = 40, NUMBER_DIGITS = 19, NUMBER_ROOM = 64 };

/* Writes a finite double at text (at least NUMBER_SIZE bytes) without a NUL; returns its length.
 * It has an exponent where that is shorter. Minus zero is "-0.0". Bytes behind the text may change
 * too. */
size_t number_write(double value, char *text);

/* The same for a whole number. */
size_t number_write_whole(uint64_t value, char *text);

/* Reads the whole of [begin, end), which must have the form of a JSON number, as the nearest
 * double. A number too small becomes 0 or a subnormal; one too large returns false, as does a text
 * that is no number. */
bool number_read(const char *begin, const char *end, double *value);

/* Reads the number at the beginning of [begin, end), as the nearest double, if it has the form of
 * JSON, no exponent, at most NUMBER_DIGITS digits and a size below 10^8. Returns the end of the
 * number, or NULL for any other text. It takes half the time if at least NUMBER_ROOM bytes are
 * readable, whatever follows the number. */
const char *number_take(const char *begin, const char *end, double *value);

/* The double nearest to digits / 10^places; places from 0 to NUMBER_DIGITS. */
double number_of_digits(uint64_t digits, int places);
