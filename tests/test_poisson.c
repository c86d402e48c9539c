#include "check.h"

#include "poisson.h"
#include "random.h"

/* P(N <= count), from the logarithms of its terms. */
static double cumulative(double mean, int count)
{
    long double sum = 0;
    for (int n = 0; n <= count; n++)
        sum += expl(n * logl((long double)mean) - (long double)mean - lgammal(n + 1.0L));
    return (double)sum;
}

static void a_count_is_the_least_whose_probability_reaches_the_draw(void **state)
{
    (void)state;
    static const struct {
        double mean, within;
    } cases[] = {{0.01, 1e-14}, {0.5, 1e-14}, {0.64, 1e-14}, {1.5, 1e-14},
                 {30, 1e-14},   {150, 1e-12}, {700, 1e-12}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        for (int n = 0; n < 1000; n++) {
            double step = cumulative(cases[i].mean, n);
            if (step > 1 - 2 * cases[i].within)
                break;
            if (step < 2 * cases[i].within)
                continue;
            if (cumulative(cases[i].mean, n - 1) < step - 2 * cases[i].within)
                assert_int_equal(poisson_draw(cases[i].mean, step - cases[i].within), n);
            if (cumulative(cases[i].mean, n + 1) > step + 2 * cases[i].within)
                assert_int_equal(poisson_draw(cases[i].mean, step + cases[i].within), n + 1);
        }
}

/* EFFECTS 9. */
static void none_is_as_likely_as_the_published_value(void **state)
{
    (void)state;
    assert_int_equal(poisson_draw(0.64, 0.527292), 0);
    assert_int_equal(poisson_draw(0.64, 0.527293), 1);
}

static void mean_and_variance_are_the_mean(void **state)
{
    (void)state;
    static const double means[] = {0.01, 0.5, 1.5, 2.097152, 30};
    enum { STEPS = 200000 };
    for (size_t i = 0; i < sizeof means / sizeof means[0]; i++) {
        double sum = 0, squares = 0;
        for (int k = 0; k < STEPS; k++) {
            double count = poisson_draw(means[i], (k + 0.5) / STEPS);
            sum += count;
            squares += (count - means[i]) * (count - means[i]);
        }
        assert_close(sum / STEPS, means[i], 3e-5 * (1 + means[i]));
        assert_close(squares / STEPS, means[i], 1e-3 * (1 + means[i]));
    }
}

static void without_a_mean_there_is_none(void **state)
{
    (void)state;
    assert_int_equal(poisson_draw(0, RANDOM_LEAST), 0);
    assert_int_equal(poisson_draw(0, 0.5), 0);
    assert_int_equal(poisson_most(0), 0);
}

static void the_most_is_that_of_the_largest_draw(void **state)
{
    (void)state;
    for (int tenths = 1; tenths <= 7000; tenths++) {
        double mean = 0.1 * tenths;
        int most = poisson_most(mean);
        assert_true(most >= poisson_draw(mean, 1 - 0x1p-52));
        assert_true(most >= mean && most < 12 + mean + 10 * sqrt(mean));
    }
}

static void a_larger_draw_never_counts_less(void **state)
{
    (void)state;
    int before = 0;
    for (int k = 0; k < 100000; k++) {
        int count = poisson_draw(30, (k + 0.5) / 100000);
        assert_true(count >= before);
        before = count;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_count_is_the_least_whose_probability_reaches_the_draw),
        cmocka_unit_test(none_is_as_likely_as_the_published_value),
        cmocka_unit_test(mean_and_variance_are_the_mean),
        cmocka_unit_test(without_a_mean_there_is_none),
        cmocka_unit_test(the_most_is_that_of_the_largest_draw),
        cmocka_unit_test(a_larger_draw_never_counts_less),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
