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
