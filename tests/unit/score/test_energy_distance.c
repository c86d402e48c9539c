#include "check.h"

#include <stdbool.h>

#include "sample.h"
#include "score/energy_distance.h"

enum { MOST = 64 };

/* Lists that are numbers, whose distance is their difference. */
static struct energy_sample sample_of(const double *place, size_t ones, size_t others,
                                      double *distance)
{
    size_t all = ones + others;
    for (size_t i = 0; i < all; i++)
        for (size_t j = 0; j < all; j++)
            distance[i * all + j] = fabs(place[i] - place[j]);
    return (struct energy_sample){distance, ones, others};
}

static void two_lists_of_each_follow_the_definition(void **state)
{
    (void)state;
    double distance[MOST];
    struct energy_sample sample = sample_of((double[]){0, 1, 5, 8}, 2, 2, distance);
    /* 2 (5 + 8 + 4 + 7)/4 - 1 - 3 */
    assert_near(energy_distance_of(&sample), 8.0, 1e-15);
}

/* For one target that is there with probability p against q, D = 2 (p - q)^2 |m|. Here all possible
 * lists come as often as they should, so the mean of the estimate over them is D exactly. */
static void a_target_listed_more_often_costs_twice_the_squared_difference(void **state)
{
    (void)state;
    double length = sqrt(3), distance[16];
    for (double p = 0; p <= 1; p += 0.25)
        for (double q = 0; q <= 1; q += 0.125) {
            double expected = 0;
            for (unsigned seen = 0; seen < 16; seen++) {
                double chance = 1, place[4];
                for (int i = 0; i < 4; i++) {
                    bool there = (seen >> i & 1) != 0;
                    double share = i < 2 ? p : q;
                    chance *= there ? share : 1 - share;
                    place[i] = there ? length : 0;
                }
                struct energy_sample sample = sample_of(place, 2, 2, distance);
                expected += chance * energy_distance_of(&sample);
            }
            assert_close(expected, 2 * (p - q) * (p - q) * length, 1e-14);
        }
}

/* Compared with the definition, from samples that are made again without each list. */
static void the_variance_is_that_of_the_jackknife(void **state)
{
    (void)state;
    const double place[] = {0.3, 1.2, -0.4, 2.2, 0.9, 1.5, -1.1};
    enum { ONES = 4, OTHERS = 3, ALL = ONES + OTHERS };
    double distance[ALL * ALL], less[ALL * ALL], value[ALL];
    struct energy_sample sample = sample_of(place, ONES, OTHERS, distance);
    for (int out = 0; out < ALL; out++) {
        double rest[ALL - 1];
        for (int i = 0, k = 0; i < ALL; i++)
            if (i != out)
                rest[k++] = place[i];
        struct energy_sample without =
            sample_of(rest, ONES - (out < ONES), OTHERS - (out >= ONES), less);
        value[out] = energy_distance_of(&without);
    }
    double variance = 0;
    for (int law = 0; law < 2; law++) {
        int first = law == 0 ? 0 : ONES, count = law == 0 ? ONES : OTHERS;
        double mean = 0, squares = 0;
        for (int i = first; i < first + count; i++)
            mean += value[i] / count;
        for (int i = first; i < first + count; i++)
            squares += (value[i] - mean) * (value[i] - mean);
        variance += (count - 1.0) / count * squares;
    }
    assert_near(energy_distance_variance(&sample), variance, 1e-12);
}

/* Numbers even in [0, 1) and in [s, 1 + s): D = 2 E|X - Y| - 2/3 with E|X - Y| = 1/3 + s^2 - s^3/3
 * for s up to 1. The mean over many samples is D; below 0 for equal laws as often as above. */
static void estimates_are_unbiased(void **state)
{
    (void)state;
    enum { ROUNDS = 4000, EACH = 5 };
    uint64_t random = 9;
    for (double shift = 0; shift <= 1; shift += 0.5) {
        double sum = 0, squares = 0, variance = 0, distance[4 * EACH * EACH], place[2 * EACH];
        int below = 0;
        for (int round = 0; round < ROUNDS; round++) {
            for (int i = 0; i < 2 * EACH; i++)
                place[i] = sample_between(&random, 0, 1) + (i < EACH ? 0 : shift);
            struct energy_sample sample = sample_of(place, EACH, EACH, distance);
            double value = energy_distance_of(&sample);
            sum += value / ROUNDS;
            squares += value * value / ROUNDS;
            variance += energy_distance_variance(&sample) / ROUNDS;
            below += value < 0;
        }
        double exact = 2 * (shift * shift - shift * shift * shift / 3);
        double error = sqrt((squares - sum * sum) / ROUNDS);
        assert_close(sum, exact, 3 * error);
        assert_true(shift > 0 || (below > ROUNDS / 2 && below < 0.7 * ROUNDS));
        assert_true(variance >= 0.9 * (squares - sum * sum)); /* the jackknife errs upwards */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_lists_of_each_follow_the_definition),
        cmocka_unit_test(a_target_listed_more_often_costs_twice_the_squared_difference),
        cmocka_unit_test(the_variance_is_that_of_the_jackknife),
        cmocka_unit_test(estimates_are_unbiased),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
