#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/intern.h"
#include "sample.h"

static void equal_names_are_one_pointer(void **state)
{
    (void)state;
    static const char *const given[] = {
        "",         "a",         "b",         "ab",
        "right_1",  "right_12",  "right_123", "articulated_truck_1",
        "\xc3\xa9", "corner_fl", "corner_fr", "articulated_truck_2"};
    enum { COUNT = sizeof given / sizeof given[0] };
    struct arena arena = {0};
    struct intern names = intern_begin(&arena, 10);
    const char *kept[COUNT];
    for (size_t i = 0; i < COUNT; i++) {
        kept[i] = intern_keep(&names, given[i], strlen(given[i]));
        assert_string_equal(kept[i], given[i]);
        assert_true(kept[i] != given[i]);
    }
    for (size_t i = 0; i < COUNT; i++)
        assert_true(intern_keep(&names, given[i], strlen(given[i])) == kept[i]);
    arena_free(&arena);
}

/* More names than places, some of them equal at both ends: each still gets its own bytes. */
static void names_that_share_a_place_are_not_mixed_up(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct intern names = intern_begin(&arena, 10);
    uint64_t random = 1;
    for (int i = 0; i < 100000; i++) {
        char name[64];
        int length = snprintf(name, sizeof name, "%.*s%llu%s", (int)(sample_bits(&random) % 12),
                              "beginning___", (unsigned long long)sample_bits(&random) % 3000,
                              i % 2 ? "_and_an_end" : "");
        /* Not NUL-terminated, and exactly this much memory, for a sanitizer to see. */
        char *bare = malloc((size_t)length);
        memcpy(bare, name, (size_t)length);
        assert_string_equal(intern_keep(&names, bare, (size_t)length), name);
        free(bare);
    }
    arena_free(&arena);
}

static void a_name_is_taken_up_to_its_quote(void **state)
{
    (void)state;
    static const char *const given[] = {"a\"", "left_3\",", "right_1\"", "right_12\" ",
                                        "articulated_truck_1\"\""};
    static const char *const others[] = {"",      "a",           "\"",    "\"a",
                                         "a\\\"", "a\xc3\xa9\"", "a\t\"", "right_123456789"};
    struct arena arena = {0};
    struct intern names = intern_begin(&arena, 10);
    size_t length;
    for (size_t i = 0; i < sizeof given / sizeof given[0]; i++) {
        size_t expected = strcspn(given[i], "\""), size = strlen(given[i]);
        char *bare = malloc(size);
        memcpy(bare, given[i], size);
        const char *name = intern_keep_quoted(&names, bare, bare + size, &length);
        assert_int_equal(length, expected);
        assert_int_equal(strlen(name), expected);
        assert_memory_equal(name, given[i], expected);
        assert_true(intern_keep(&names, given[i], expected) == name);
        free(bare);
    }
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        assert_null(intern_keep_quoted(&names, others[i], others[i] + strlen(others[i]), &length));
    arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_names_are_one_pointer),
        cmocka_unit_test(names_that_share_a_place_are_not_mixed_up),
        cmocka_unit_test(a_name_is_taken_up_to_its_quote),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
