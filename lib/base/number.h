/* Doubles as text: the shortest decimal that reads back to the same double, and the nearest double
 * to a decimal. The one corner of C++ in glint (std::to_chars, std::from_chars), because C's own
 * printf and strtod are ten times slower and depend on the locale. Most numbers of a frame lie
 * where the shortest decimal follows from one exact product; they take half the time of
 * std::to_chars. */
#ifndef NUMBER_H
#define NUMBER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { NUMBER_SIZE = 32, NUMBER_DIGITS = 19 };

/* Writes a finite double at text (at least NUMBER_SIZE bytes) without a NUL; returns its length.
 * Minus zero is "-0.0". */
size_t number_write(double value, char *text);

/* Writes a whole number at text (at least NUMBER_SIZE bytes) without a NUL; returns its length. */
size_t number_write_whole(uint64_t value, char *text);

/* Reads the whole of [begin, end), which must have the form of a JSON number, as the nearest
 * double. Too small becomes 0 or a subnormal; false if too large. */
bool number_read(const char *begin, const char *end, double *value);

/* Reads the number with which [begin, end) begins, as the nearest double, if it is an everyday one:
 * in the form of JSON, without an exponent, of no more than NUMBER_DIGITS digits and less than
 * 10^8. Where it ends; NULL if it is another one, or none. */
const char *number_take(const char *begin, const char *end, double *value);

/* The double nearest to digits / 10^places; places from 0 to NUMBER_DIGITS. */
double number_of_digits(uint64_t digits, int places);

#ifdef __cplusplus
}
#endif

#endif
