#include "check.h"

#include "base/random_sequence.h"

#define DRAWS 100000

static const struct random_address ADDRESS = {.seed = 1, .scene = 2, .frame = 3, .item = 4};

static void draws_are_the_blocks_of_their_address_in_order(void **state)
{
    (void)state;
    struct random_sequence draws = random_sequence_at(ADDRESS, RANDOM_TRAFFIC);
    for (uint32_t block = 0; block < 3; block++) {
        double uniform[4];
        random_uniform(&ADDRESS, RANDOM_TRAFFIC, block, uniform);
        for (int i = 0; i < 4; i++)
            assert_close(random_sequence_next(&draws), uniform[i], 0);
    }
}

/* The tolerance is five standard deviations of a count. */
static void whole_numbers_come_equally_often(void **state)
{
    (void)state;
    struct random_sequence draws = random_sequence_at(ADDRESS, RANDOM_TRAFFIC);
    double hits[5] = {0}, expected = DRAWS / 5.0;
    for (int i = 0; i < DRAWS; i++) {
        int64_t number = random_sequence_whole(&draws, -2, 2);
        assert_true(number >= -2 && number <= 2);
        hits[number + 2]++;
    }
    for (int i = 0; i < 5; i++)
        assert_close(hits[i], expected, 5 * sqrt(0.8 * expected));
    assert_int_equal(random_sequence_whole(&draws, 7, 7), 7);
}

static void numbers_between_two_come_equally_often_from_each_quarter(void **state)
{
    (void)state;
    struct random_sequence draws = random_sequence_at(ADDRESS, RANDOM_TRAFFIC);
    double hits[4] = {0};
    for (int i = 0; i < DRAWS; i++) {
        double number = random_sequence_between(&draws, -3, 5);
        assert_true(number >= -3 && number <= 5);
        hits[(int)fmin((number + 3) / 2, 3)]++;
    }
    for (int i = 0; i < 4; i++)
        assert_close(hits[i], DRAWS / 4.0, 5 * sqrt(DRAWS * 3 / 16.0));
}

static void chances_are_as_given(void **state)
{
    (void)state;
    struct random_sequence draws = random_sequence_at(ADDRESS, RANDOM_TRAFFIC);
    double hits = 0, right = 0;
    for (int i = 0; i < DRAWS; i++) {
        hits += random_sequence_chance(&draws, 0.03);
        right += random_sequence_sign(&draws) > 0;
    }
    assert_close(hits, 0.03 * DRAWS, 5 * sqrt(0.03 * DRAWS));
    assert_close(right, 0.5 * DRAWS, 5 * sqrt(0.25 * DRAWS));
}

/* One in eight is 0; of the others a sixth lies in each decade, half of them on either side. */
static void margins_reach_down_six_decades_on_both_sides(void **state)
{
    (void)state;
    struct random_sequence draws = random_sequence_at(ADDRESS, RANDOM_TRAFFIC);
    double zeros = 0, negative = 0, decade[6] = {0};
    for (int i = 0; i < DRAWS; i++) {
        double margin = random_sequence_margin(&draws, 1e-3), size = fabs(margin);
        assert_true(size <= 1e-3 && (size == 0 || size >= 1e-9));
        zeros += size == 0;
        negative += margin < 0;
        if (size > 0)
            decade[(int)fmin(-log10(size) - 3, 5)]++;
    }
    assert_close(zeros, DRAWS / 8.0, 5 * sqrt(DRAWS / 8.0));
    assert_close(negative, DRAWS * 7 / 16.0, 5 * sqrt(DRAWS / 4.0));
    for (int i = 0; i < 6; i++)
        assert_close(decade[i], DRAWS * 7 / 48.0, 5 * sqrt(DRAWS * 7 / 48.0));
}

/* To a thousandth. */
static void one_margin_in_eight_is_0(void **state)
{
    (void)state;
    enum { MANY = 4000000 };
    struct random_sequence draws = random_sequence_at(ADDRESS, RANDOM_TRAFFIC);
    double zeros = 0;
    for (int i = 0; i < MANY; i++)
        zeros += random_sequence_margin(&draws, 1) == 0;
    assert_close(zeros / MANY, 1 / 8.0, 1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(draws_are_the_blocks_of_their_address_in_order),
        cmocka_unit_test(whole_numbers_come_equally_often),
        cmocka_unit_test(numbers_between_two_come_equally_often_from_each_quarter),
        cmocka_unit_test(chances_are_as_given),
        cmocka_unit_test(margins_reach_down_six_decades_on_both_sides),
        cmocka_unit_test(one_margin_in_eight_is_0),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
