#include "check.h"

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

TEST(a_slip_of_a_letter_or_two_is_understood)
{
    static const char *const cases[][2] = {
        {"sensor", "sensors"},  {"sesnors", "sensors"},   {"acount", "account"},
        {"effetcs", "effects"}, {"radius_m", "radius-m"}, {"seeed", "seed"},
        {"seet", "seed"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        char expected[64];
        snprintf(expected, sizeof expected, " (did you mean --%s?)", cases[i][1]);
        assert_string_equal(meant(cases[i][0], options), expected);
    }
}

TEST(two_swapped_letters_are_one_change)
{
    assert_string_equal(meant("seta", (const char *const[]){"seat", NULL}),
                        " (did you mean --seat?)");
}

TEST(case_does_not_count)
{
    assert_string_equal(meant("PEDESTRIAN", classes), " (did you mean --pedestrian?)");
}

TEST(a_beginning_of_three_letters_is_enough)
{
    assert_string_equal(meant("acc", options), " (did you mean --account?)");
    assert_string_equal(meant("ac", options), "");
}

TEST(a_word_far_from_all_gets_no_suggestion)
{
    assert_string_equal(meant("hovercraft", classes), "");
    assert_string_equal(meant("z_m", (const char *const[]){"x_m", "y_m", NULL}), "");
    assert_string_equal(meant("", options), "");
}

TEST(of_equally_near_words_the_first_by_its_bytes_is_meant)
{
    assert_string_equal(meant("road", (const char *const[]){"toad", "read", "roar", NULL}),
                        " (did you mean --read?)");
}

TEST(words_too_long_for_the_table_are_left_alone)
{
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
