/* Numbers as text by the compiler's own C++ library: the floor of shortest digits, which does not
 * move when lib/base/number.c gets faster. */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

/* Writes the shortest decimal that reads back to the value, at most 32 bytes; returns its end. */
char *digits_write(double value, char *at);

/* Reads a decimal; returns its end. */
const char *digits_read(const char *at, const char *end, double *value);

#ifdef __cplusplus
}
#endif
