#include "check.h"

#include <stdio.h>
#include <string.h>

#include "base/suggestion.h"

static const char *meant(const char *word, const char *const *known)
{
    static struct suggestion suggestion;
    suggestion = suggestion_begin(word, strlen(word));
    for (size_t i = 0; known[i] != NULL; i++)
        suggestion_offer(&suggestion, known[i]);
    return suggestion_question(&suggestion, "--");
}

static const char *const options[] = {"sensors", "account", "effects", "radius-m",
                                      "seed",    "keep",    NULL};
static const char *const classes[] = {"bus", "car", "pedestrian", "truck", "van", NULL};

static void a_slip_of_a_letter_or_two_is_understood(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"sensor", "sensors"},  {"sesnors", "sensors"},   {"acount", "account"},
        {"effetcs", "effects"}, {"radius_m", "radius-m"}, {"seeed", "seed"},
        {"seet", "seed"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char expected[64];
        snprintf(expected, sizeof expected, " (did you mean --%s?)", cases[i][1]);
        assert_string_equal(meant(cases[i][0], options), expected);
    }
}

static void two_swapped_letters_are_one_change(void **state)
{
    (void)state;
    assert_string_equal(meant("seta", (const char *const[]){"seat", NULL}),
                        " (did you mean --seat?)");
}

static void case_does_not_count(void **state)
{
    (void)state;
    assert_string_equal(meant("PEDESTRIAN", classes), " (did you mean --pedestrian?)");
}

static void a_beginning_of_three_letters_is_enough(void **state)
{
    (void)state;
    assert_string_equal(meant("acc", options), " (did you mean --account?)");
    assert_string_equal(meant("ac", options), "");
}

static void a_word_far_from_all_gets_no_suggestion(void **state)
{
    (void)state;
    assert_string_equal(meant("hovercraft", classes), "");
    assert_string_equal(meant("z_m", (const char *const[]){"x_m", "y_m", NULL}), "");
    assert_string_equal(meant("", options), "");
}

static void of_equally_near_words_the_first_by_its_bytes_is_meant(void **state)
{
    (void)state;
    assert_string_equal(meant("road", (const char *const[]){"toad", "read", "roar", NULL}),
                        " (did you mean --read?)");
}

static void words_too_long_for_the_table_are_left_alone(void **state)
{
    (void)state;
    char word[SUGGESTION_SIZE + 1], near[SUGGESTION_SIZE];
    memset(word, 'a', sizeof word);
    word[SUGGESTION_SIZE] = '\0';
    memset(near, 'a', sizeof near);
    near[SUGGESTION_SIZE - 1] = '\0';
    assert_string_equal(meant(word, (const char *const[]){near, NULL}), "");
    assert_string_equal(meant(near + 1, (const char *const[]){word, NULL}), "");
    near[0] = 'b';
    assert_true(strlen(meant(near, (const char *const[]){word + 1, NULL})) > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_slip_of_a_letter_or_two_is_understood),
        cmocka_unit_test(two_swapped_letters_are_one_change),
        cmocka_unit_test(case_does_not_count),
        cmocka_unit_test(a_beginning_of_three_letters_is_enough),
        cmocka_unit_test(a_word_far_from_all_gets_no_suggestion),
        cmocka_unit_test(of_equally_near_words_the_first_by_its_bytes_is_meant),
        cmocka_unit_test(words_too_long_for_the_table_are_left_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
