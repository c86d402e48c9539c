#include "check.h"

#include "base/random.h"

#define DRAWS 100000

static const struct random_address ADDRESS = {.seed = 1, .scene = 2, .frame = 3, .item = 4};

TEST(draws_are_the_blocks_of_their_address_in_order)
{
    struct random_sequence draws = random_sequence_at(ADDRESS, RANDOM_TRAFFIC);
    for (uint32_t block = 0; block < 3; block++) {
        double uniform[4];
        random_uniform(&ADDRESS, RANDOM_TRAFFIC, block, uniform);
        for (int i = 0; i < 4; i++)
            assert_close(random_sequence_next(&draws), uniform[i], 0);
    }
}

/* The tolerance is five standard deviations of a count. */
TEST(whole_numbers_come_equally_often)
{
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

TEST(numbers_between_two_come_equally_often_from_each_quarter)
{
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

TEST(chances_are_as_given)
{
    struct random_sequence draws = random_sequence_at(ADDRESS, RANDOM_TRAFFIC);
    double hits = 0, right = 0;
    for (int i = 0; i < DRAWS; i++) {
        hits += random_sequence_chance(&draws, 0.03);
        right += random_sequence_sign(&draws) > 0;
    }
    assert_close(hits, 0.03 * DRAWS, 5 * sqrt(0.03 * DRAWS));
    assert_close(right, 0.5 * DRAWS, 5 * sqrt(0.25 * DRAWS));
}
