/* Tests in cmocka: how a file lists its tests, comparisons in double precision, since its
 * assert_float_equal compares in single precision, and tests that cannot run here. */
#pragma once

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/diag.h"

/* What a file says of its tests: a test with its setup and teardown, or with no name what is done
 * before the first and after the last of the tests that follow. */
struct check_entry {
    const char *file;
    int line;
    struct CMUnitTest test;
};

/* The linker joins the entries of all files of a program, which check_main.c runs. */
#define CHECK_ENTRY(entry, name, ...)                                                              \
    static const struct check_entry entry = {__FILE__, __LINE__, {name, __VA_ARGS__, NULL}};       \
    static const struct check_entry *const entry##_listed                                          \
        __attribute__((section("check_entries"), used)) = &entry

/* TEST(a_sentence_about_behaviour) { ... } is a test. */
#define TEST(name)                                                                                 \
    static void name(void);                                                                        \
    static void name##_alone(void **state __attribute__((unused)))                                 \
    {                                                                                              \
        name();                                                                                    \
        check_end();                                                                               \
    }                                                                                              \
    CHECK_ENTRY(name##_entry, #name, name##_alone, NULL, NULL);                                    \
    static void name(void)

/* A test with a setup and a teardown of its own. Its subject, as struct scratch *scratch, is what
 * the setup made. */
#define TEST_WITH(setup, teardown, subject, name)                                                  \
    static void name(subject);                                                                     \
    static void name##_of_state(void **state)                                                      \
    {                                                                                              \
        name(*state);                                                                              \
        check_end();                                                                               \
    }                                                                                              \
    CHECK_ENTRY(name##_entry, #name, name##_of_state, setup, teardown);                            \
    static void name(subject __attribute__((unused)))

/* FIXTURE(setup, teardown); holds for the tests that follow it in its file. */
#define FIXTURE(setup, teardown) CHECK_ENTRY(setup##_and_##teardown, NULL, NULL, setup, teardown)

/* TEST_OF(scratch, a_sentence) { ... } is a test of what the fixture's setup made, a
 * struct scratch *scratch. */
#define TEST_OF(subject, name) TEST_WITH(NULL, NULL, struct subject *subject, name)

/* A test of what make, a function without parameters, returns. Its memory is that of check_arena or
 * static. */
#define TEST_FROM(make, subject, name)                                                             \
    static void name(subject);                                                                     \
    static void name##_made(void **state __attribute__((unused)))                                  \
    {                                                                                              \
        name(make());                                                                              \
        check_end();                                                                               \
    }                                                                                              \
    CHECK_ENTRY(name##_entry, #name, name##_made, NULL, NULL);                                     \
    static void name(subject __attribute__((unused)))

/* What a setup makes: zeroed memory, which its teardown frees. */
static inline void *check_make(void **state, size_t size)
{
    *state = calloc(1, size);
    assert_non_null(*state);
    return *state;
}

/* Memory of the test that runs; it is freed when the test has passed. */
struct arena *check_arena(void);

/* An empty text of the test that runs; it is freed when the test has passed. */
struct text *check_text(void);

void check_end(void);

/* Of an array, not of a pointer. */
#define COUNT(array) (sizeof(array) / sizeof(array)[0])

/* In radians, with PI of base/units.h. */
#define DEGREE (PI / 180)

/* How many cases a test of random cases takes: so many, or what the environment has in CASES. */
double check_cases(double usual);

/* Passes if |actual - expected| <= tolerance; fails for NaN. Prints 17 digits. */
#define assert_close(actual, expected, tolerance)                                                  \
    check_close((actual), (expected), (tolerance), #actual, __FILE__, __LINE__)

/* Passes if |actual - expected| <= tolerance |expected|. */
#define assert_near(actual, expected, relative)                                                    \
    check_close((actual), (expected), (relative)*fabs(expected), #actual, __FILE__, __LINE__)

/* Calls a function with these arguments and with a diag as the last. Passes if it gives 0. */
#define assert_done(function, ...)                                                                 \
    do {                                                                                           \
        struct diag check_diag = {0};                                                              \
        if (function(__VA_ARGS__, &check_diag) != 0)                                               \
            fail_msg("%s: %s", #function, check_diag.text);                                        \
    } while (0)

/* The same; passes if it gives -1 with this code and message. */
#define assert_refused(expected_code, expected_text, function, ...)                                \
    do {                                                                                           \
        struct diag check_diag = {0};                                                              \
        assert_int_equal(function(__VA_ARGS__, &check_diag), -1);                                  \
        assert_string_equal(check_diag.text, expected_text);                                       \
        assert_int_equal(check_diag.code, expected_code);                                          \
    } while (0)

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
