#include "check.h"

#include "sample.h"
#include "score/error_statistics.h"

static void the_mean_is_signed_and_the_other_figures_are_sizes(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct error_statistics of = error_statistics_of((double[]){-3, 1, 1, 1}, 4, &arena);
    assert_close(of.mean, 0, 0);
    assert_near(of.rms, sqrt(3), 1e-15);
    assert_close(of.max, 3, 0);
    of = error_statistics_of((double[]){-2}, 1, &arena);
    assert_close(of.mean, -2, 0);
    assert_close(of.rms, 2, 0);
    assert_close(of.p95, 2, 0);
    assert_close(of.max, 2, 0);
    arena_free(&arena);
}

static void ninety_five_of_a_hundred_are_no_larger(void **state)
{
    (void)state;
    struct arena arena = {0};
    double values[100];
    for (int i = 0; i < 100; i++)
        values[i] = (i % 2 == 0 ? 1 : -1) * (100 - i);
    assert_close(error_statistics_of(values, 100, &arena).p95, 95, 0);
    assert_close(error_statistics_of(values, 19, &arena).p95, 19, 0);
    assert_close(error_statistics_of(values, 20, &arena).p95, 19, 0);
    arena_free(&arena);
}

static void a_shifted_sample_is_apart_by_its_shift(void **state)
{
    (void)state;
    struct arena arena = {0};
    uint64_t sample = 1;
    double one[40], other[40], same[40];
    for (int round = 0; round < 200; round++) {
        double shift = sample_between(&sample, -10, 10);
        for (int i = 0; i < 40; i++) {
            one[i] = sample_between(&sample, -5, 5);
            other[39 - i] = one[i] + shift;
            same[(i + 7) % 40] = one[i];
        }
        assert_close(error_statistics_wasserstein(one, 40, other, 40, &arena), fabs(shift), 1e-13);
        assert_close(error_statistics_wasserstein(one, 40, same, 40, &arena), 0, 0);
        arena_clear(&arena);
    }
    arena_free(&arena);
}

static void samples_of_different_sizes_share_their_mass(void **state)
{
    (void)state;
    struct arena arena = {0};
    double zero[] = {0}, pair[] = {3, 1}, three[] = {0, 3, 3};
    assert_near(error_statistics_wasserstein(zero, 1, pair, 2, &arena), 2.0, 1e-15);
    assert_near(error_statistics_wasserstein(three, 3, zero, 1, &arena), 2.0, 1e-15);
    /* Up to the quantile 1/3 the values are 1 and 0, up to 1/2 they are 1 and 3, then both are
     * 3. */
    assert_near(error_statistics_wasserstein(pair, 2, three, 3, &arena), 2.0 / 6 + 1.0 / 3, 1e-15);
    arena_free(&arena);
}

/* Compared with the definition over quantiles: the mean of |sorted one - sorted other| for equal
 * counts. */
static void samples_of_one_size_are_apart_as_their_sorted_values(void **state)
{
    (void)state;
    struct arena arena = {0};
    uint64_t sample = 3;
    for (int round = 0; round < 1000; round++) {
        double one[2], other[2];
        for (int i = 0; i < 2; i++) {
            one[i] = sample_between(&sample, -1, 1);
            other[i] = sample_between(&sample, -1, 1);
        }
        double expected = (fabs(fmin(one[0], one[1]) - fmin(other[0], other[1])) +
                           fabs(fmax(one[0], one[1]) - fmax(other[0], other[1]))) /
                          2;
        assert_close(error_statistics_wasserstein(one, 2, other, 2, &arena), expected, 1e-15);
        arena_clear(&arena);
    }
    arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mean_is_signed_and_the_other_figures_are_sizes),
        cmocka_unit_test(ninety_five_of_a_hundred_are_no_larger),
        cmocka_unit_test(a_shifted_sample_is_apart_by_its_shift),
        cmocka_unit_test(samples_of_different_sizes_share_their_mass),
        cmocka_unit_test(samples_of_one_size_are_apart_as_their_sorted_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
