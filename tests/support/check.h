/* cmocka, comparisons in double precision, since its assert_float_equal compares in single
 * precision, and tests that cannot run here. */
#pragma once

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Passes if |actual - expected| <= tolerance; fails for NaN. Prints 17 digits. */
#define assert_close(actual, expected, tolerance)                                                  \
    check_close((actual), (expected), (tolerance), #actual, __FILE__, __LINE__)

/* Passes if |actual - expected| <= tolerance |expected|. */
#define assert_near(actual, expected, relative)                                                    \
    check_close((actual), (expected), (relative)*fabs(expected), #actual, __FILE__, __LINE__)

static inline void check_close(double actual, double expected, double tolerance, const char *what,
                               const char *file, int line)
{
    if (!(fabs(actual - expected) <= tolerance)) {
        print_error("%s is %.17g, expected %.17g within %.3g\n", what, actual, expected, tolerance);
        _fail(file, line);
    }
}

/* Ends a test that cannot run here, with a line that make shows. */
#define skip_because(reason)                                                                       \
    do {                                                                                           \
        print_message("skipped  %s: %s\n", __func__, reason);                                      \
        skip();                                                                                    \
    } while (0)
