#include "check.h"

#include "base/random.h"
#include "sample.h"

/* The probability of k by its textbook form, or with an overdispersion that of a negative binomial
 * count with r = m^2/(s^2 - m) and p = m/s^2, from logarithms of gamma functions in extended
 * precision. */
static long double probability(double mean, double overdispersion, int64_t count)
{
    long double k = (long double)count, m = (long double)mean, f = (long double)overdispersion;
    if (overdispersion == 1)
        return expl(k * logl(m) - m - lgammal(k + 1));
    long double r = m / (f - 1);
    return expl(lgammal(k + r) - lgammal(r) - lgammal(k + 1) - r * logl(f) + k * logl(1 - 1 / f));
}

static const double means[] = {1e-6, 0.032768, 0.5,  0.64, 1,    2.097152, 7.5,
                               15.9, 16,       16.1, 94,   1000, 5000,     20000};

/* Each uniform draw must lie between two neighbouring sums of the exact probabilities. */
TEST(a_count_is_where_the_sum_of_probabilities_passes_the_draw)
{
    static const double uniforms[] = {0x1p-53, 1e-12, 1e-6, 1e-3, 0.01, 0.1,   0.3,      0.5,
                                      0.527,   0.6,   0.8,  0.9,  0.99, 0.999, 0.999999, 1 - 1e-9};
    for (size_t i = 0; i < COUNT(means); i++) {
        long double sum = 0;
        int64_t next = 0;
        for (size_t j = 0; j < COUNT(uniforms); j++) {
            int64_t count = random_poisson(means[i], uniforms[j]);
            assert_true(count >= 0 && count + 1 >= next);
            while (next < count)
                sum += probability(means[i], 1, next++);
            long double slack = 1e-11L * (long double)uniforms[j] + 1e-14L;
            long double with = sum + probability(means[i], 1, count);
            if (next > count) /* the sum holds the count already */
                with = sum;
            else
                assert_true(sum <= (long double)uniforms[j] + slack);
            assert_true(with >= (long double)uniforms[j] - slack);
        }
    }
}

TEST(a_mean_of_0_64_gives_no_false_alarm_in_half_of_all_scans)
{
    assert_int_equal(random_poisson(6400 * 1e-4, 0.5272919), 0);
    assert_int_equal(random_poisson(6400 * 1e-4, 0.5272930), 1);
    assert_int_equal(random_poisson(32768e-6, 0.96776), 0);
    assert_int_equal(random_poisson(32768e-6, 0.96777), 1);
}

TEST(counts_are_bounded_and_invalid_means_give_zero)
{
    static const double none[] = {0, -0.0, -1, -HUGE_VAL, (double)NAN};
    for (size_t i = 0; i < COUNT(none); i++)
        assert_int_equal(random_poisson(none[i], 1 - 0x1p-53), 0);
    assert_int_equal(random_poisson(1e-300, 1 - 0x1p-53), 0);
    assert_in_range(random_poisson(0.5, 1 - 0x1p-53), 12, 60);
    assert_in_range(random_poisson(1000, 0x1p-53), 700, 1000);
    assert_in_range(random_poisson(1000, 1 - 0x1p-53), 1000, 1350);
    assert_int_equal(random_poisson(HUGE_VAL, 0.25), random_poisson(1e9, 0.25));
    assert_in_range(random_poisson(1e9, 0.5), 1000000000 - 2, 1000000000 + 2);
}

TEST(counts_never_fall_when_their_draw_grows)
{
    for (size_t i = 0; i < COUNT(means); i++) {
        int64_t before = 0;
        for (double uniform = 0x1p-11; uniform < 1; uniform += 0x1p-10) {
            int64_t count = random_poisson(means[i], uniform);
            assert_true(count >= before);
            before = count;
        }
    }
}

enum { DRAWS = 100000, MOST = 8000 };

/* Counts with an overdispersion f have a mean that varies as a gamma variate times f - 1.
 * Pearson's chi square over counts joined until 50 are expected. Its mean is the number of joined
 * counts less one, its variance twice that; five standard deviations above the mean are allowed. */
static void check_frequencies(double mean, double overdispersion, uint64_t *sample)
{
    static int seen[MOST];
    struct random_sequence gamma = random_sequence_at((struct random_address){0}, RANDOM_OWN);
    for (int k = 0; k < MOST; k++)
        seen[k] = 0;
    for (int i = 0; i < DRAWS; i++) {
        double more = overdispersion - 1;
        double varied = more > 0 ? more * random_gamma(&gamma, mean / more) : mean;
        int64_t count = random_poisson(varied, sample_between(sample, 0x1p-50, 1));
        seen[count < MOST ? count : MOST - 1]++;
    }
    double chi_square = 0, expected = 0, observed = 0, used = 0;
    int groups = 0;
    for (int k = 0; k < MOST; k++) {
        expected += DRAWS * (double)probability(mean, overdispersion, k);
        observed += seen[k];
        if (expected >= 50 && DRAWS - used - expected >= 50) {
            chi_square += (observed - expected) * (observed - expected) / expected;
            used += expected;
            groups++;
            expected = observed = 0;
        }
    }
    expected = DRAWS - used;
    chi_square += (observed - expected) * (observed - expected) / expected;
    assert_true(chi_square < groups + 5 * sqrt(2.0 * groups));
    assert_true(chi_square > groups - 5 * sqrt(2.0 * groups) || groups < 5);
}

TEST(frequencies_are_those_of_the_distribution)
{
    static const double cases[][2] = {{0.5, 1}, {1.5, 1},  {12, 1},      {94, 1},       {1000, 1},
                                      {2, 3},   {12, 4.5}, {94, 3.4468}, {200, 19.845}, {3, 10}};
    uint64_t sample = 9;
    for (size_t i = 0; i < COUNT(cases); i++)
        check_frequencies(cases[i][0], cases[i][1], &sample);
}
