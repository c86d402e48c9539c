#include "check.h"

#include "base/random.h"

#define DRAWS 250000

static const struct random_address ADDRESS = {
    .seed = 1, .scene = 2, .frame = 3, .sensor = 4, .item = 5};

/* Known answers of Philox4x64-10 as published with Random123: counter, key, block. */
TEST(draws_are_philox_blocks)
{
    static const struct {
        uint64_t counter[4], key[2], block[4];
    } cases[] = {
        {{0, 0, 0, 0},
         {0, 0},
         {UINT64_C(0x16554d9eca36314c), UINT64_C(0xdb20fe9d672d0fdc), UINT64_C(0xd7e772cee186176b),
          UINT64_C(0x7e68b68aec7ba23b)}},
        {{UINT64_MAX, UINT64_MAX, UINT64_MAX, UINT64_MAX},
         {UINT64_MAX, UINT64_MAX},
         {UINT64_C(0x87b092c3013fe90b), UINT64_C(0x438c3c67be8d0224), UINT64_C(0x9cc7d7c69cd777b6),
          UINT64_C(0xa09caebf594f0ba0)}},
        {{UINT64_C(0x243f6a8885a308d3), UINT64_C(0x13198a2e03707344), UINT64_C(0xa4093822299f31d0),
          UINT64_C(0x082efa98ec4e6c89)},
         {UINT64_C(0x452821e638d01377), UINT64_C(0xbe5466cf34e90c6c)},
         {UINT64_C(0xa528f45403e61d95), UINT64_C(0x38c72dbd566e9788), UINT64_C(0xa5a1610e72fd18b5),
          UINT64_C(0x57bd43b5e52b7fe6)}},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct random_address address = {.seed = cases[i].key[0],
                                         .scene = cases[i].key[1],
                                         .frame = cases[i].counter[0],
                                         .sensor = cases[i].counter[1],
                                         .item = cases[i].counter[2]};
        double uniform[4];
        random_uniform(&address, (enum random_purpose)(cases[i].counter[3] >> 32),
                       (uint32_t)cases[i].counter[3], uniform);
        for (int k = 0; k < 4; k++) {
            double high_bits = (double)(cases[i].block[k] / 4096);
            assert_close(uniform[k], (2 * high_bits + 1) / 0x1p53, 0);
        }
    }
}

TEST(the_same_address_draws_the_same)
{
    double first[4];
    double again[4];
    random_gaussian(&ADDRESS, RANDOM_POINTERS, 7, first);
    random_uniform(&ADDRESS, RANDOM_TRAFFIC, 0, again);
    random_gaussian(&ADDRESS, RANDOM_POINTERS, 7, again);
    assert_memory_equal(first, again, sizeof first);
    random_gaussian_pair(&ADDRESS, RANDOM_POINTERS, 7, again);
    assert_memory_equal(first, again, 2 * sizeof *first);
}

static void assert_all_differ(const double first[4], const double second[4])
{
    for (int i = 0; i < 4; i++)
        assert_true(fabs(first[i] - second[i]) > 0);
}

TEST(every_bit_of_the_address_counts)
{
    double reference[4];
    random_uniform(&ADDRESS, RANDOM_POINTERS, 0, reference);
    for (size_t member = 0; member < 5; member++)
        for (int bit = 0; bit < 64; bit++) {
            uint64_t words[5] = {ADDRESS.seed, ADDRESS.scene, ADDRESS.frame, ADDRESS.sensor,
                                 ADDRESS.item};
            words[member] ^= UINT64_C(1) << bit;
            struct random_address changed = {words[0], words[1], words[2], words[3], words[4]};
            double uniform[4];
            random_uniform(&changed, RANDOM_POINTERS, 0, uniform);
            assert_all_differ(reference, uniform);
        }
}

TEST(purposes_and_indices_draw_different_numbers)
{
    static const enum random_purpose purposes[] = {
        RANDOM_POINTERS, RANDOM_RANGE_RATE, RANDOM_AZIMUTH, RANDOM_TRAFFIC,
        RANDOM_OWN,      RANDOM_OWN + 1,    INT32_MAX};
    enum { PURPOSES = sizeof purposes / sizeof *purposes, ALL = 3 * PURPOSES };
    double drawn[ALL][4];
    for (uint32_t i = 0; i < ALL; i++)
        random_uniform(&ADDRESS, purposes[i % PURPOSES], i / PURPOSES, drawn[i]);
    for (size_t i = 0; i < ALL; i++)
        for (size_t k = 0; k < i; k++)
            assert_all_differ(drawn[i], drawn[k]);
}

/* With 99 degrees of freedom 173 is exceeded by chance once in 100 000. */
TEST(uniform_draws_fill_the_open_interval_evenly)
{
    double hits[100] = {0};
    for (uint32_t i = 0; i < DRAWS; i++) {
        double uniform[4];
        random_uniform(&ADDRESS, RANDOM_TRAFFIC, i, uniform);
        for (int k = 0; k < 4; k++) {
            assert_true(uniform[k] > 0 && uniform[k] < 1);
            hits[(int)(100 * uniform[k])]++;
        }
    }
    double chi_squared = 0;
    for (int i = 0; i < 100; i++)
        chi_squared += (hits[i] - DRAWS / 25.0) * (hits[i] - DRAWS / 25.0) / (DRAWS / 25.0);
    assert_true(chi_squared > 45 && chi_squared < 173);
}

/* Tolerances are five standard errors over a million draws. */
TEST(gaussian_draws_have_gaussian_moments)
{
    double power[5] = {0};
    for (uint32_t i = 0; i < DRAWS; i++) {
        double gaussian[4];
        random_gaussian(&ADDRESS, RANDOM_POINTERS, i, gaussian);
        for (int k = 0; k < 4; k++) {
            assert_true(fabs(gaussian[k]) < 8.58);
            for (int n = 1; n <= 4; n++)
                power[n] += pow(gaussian[k], n) / (4.0 * DRAWS);
        }
    }
    assert_close(power[1], 0, 5e-3);
    assert_close(power[2], 1, 5 * sqrt(2) * 1e-3);
    assert_close(power[3], 0, 5 * sqrt(15) * 1e-3);
    assert_close(power[4], 3, 5 * sqrt(96) * 1e-3);
}

TEST(gaussian_draws_have_gaussian_tails)
{
    double beyond[5] = {0};
    for (uint32_t i = 0; i < DRAWS; i++) {
        double gaussian[4];
        random_gaussian(&ADDRESS, RANDOM_RANGE_RATE, i, gaussian);
        for (int k = 0; k < 4; k++)
            for (int n = 1; n <= 4; n++)
                beyond[n] += fabs(gaussian[k]) > n;
    }
    for (int n = 1; n <= 4; n++) {
        double expected = 4.0 * DRAWS * erfc(n / sqrt(2));
        assert_close(beyond[n], expected, 5 * sqrt(expected));
    }
}

TEST(the_four_gaussians_of_a_block_are_uncorrelated)
{
    double product[4][4] = {{0}};
    for (uint32_t i = 0; i < DRAWS; i++) {
        double gaussian[4];
        random_gaussian(&ADDRESS, RANDOM_AZIMUTH, i, gaussian);
        for (int k = 0; k < 4; k++)
            for (int n = 0; n < k; n++)
                product[k][n] += gaussian[k] * gaussian[n] / DRAWS;
    }
    for (int k = 0; k < 4; k++)
        for (int n = 0; n < k; n++)
            assert_close(product[k][n], 0, 5 / sqrt(DRAWS));
}

/* The first Gaussian draw of 10 000 addresses that differ by one in one member. By chance the
 * correlation is about 0.01. */
TEST(neighbouring_addresses_are_uncorrelated)
{
    for (size_t member = 0; member < 5; member++) {
        double correlation = 0;
        double previous = 0;
        for (uint64_t i = 0; i <= 10000; i++) {
            uint64_t words[5] = {9, 9, 9, 9, 9};
            words[member] = i;
            struct random_address address = {words[0], words[1], words[2], words[3], words[4]};
            double gaussian[4];
            random_gaussian(&address, RANDOM_POINTERS, 0, gaussian);
            if (i > 0)
                correlation += gaussian[0] * previous / 10000;
            previous = gaussian[0];
        }
        assert_close(correlation, 0, 0.045);
    }
}

/* The density at x times the error of x is the error of the probability. */
TEST(a_gaussian_exceeds_the_value_with_the_probability)
{
    for (double probability = RANDOM_LEAST; probability < 1; probability *= 1.1) {
        double value = random_gaussian_exceeded(probability);
        double density = exp(-value * value / 2) / sqrt(2 * acos(-1));
        assert_close(0.5 * erfc(value / sqrt(2)), probability,
                     2e-7 * fmax(1, fabs(value)) * density);
        assert_close(random_gaussian_exceeded(1 - probability), -value,
                     probability > 1e-4 ? 1e-9 : 1);
    }
    assert_close(random_gaussian_exceeded(0.5), 0, 0);
}
