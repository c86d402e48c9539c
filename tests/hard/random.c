/* Random numbers: hard cases 48 to 53. What draws cost is measured by scripts/bench. */
#include "chain.h"

#include "base/elementary.h"
#include "base/hash.h"
#include "base/random.h"
#include "base/units.h"

enum { PRECISION = 200 };

static double any_uniform(struct random_address *address, uint32_t index)
{
    double uniform[4];
    random_uniform(address, RANDOM_OWN, index, uniform);
    return uniform[0];
}

/* How many uniforms of a plain mapping of bits are outside (0, 1), for bits that are all zeros and
 * all ones. */
static double count_plain_ends(void)
{
    const double ends[] = {0 / 0x1p32, (double)((float)UINT32_MAX / 0x1p32f),
                           (0x1p53 - 1 + 0.5) * 0x1p-53};
    double wrong = 0;
    for (size_t i = 0; i < 3; i++)
        wrong += !(ends[i] > 0 && ends[i] < 1);
    return wrong;
}

/* Hard case 48: an odd multiple of 2^-53 is (k + 1/2) 2^-52, so all 52 bits count, and it is
 * neither 0 nor 1. */
TEST(a_uniform_draw_is_never_0_or_1)
{
    struct random_address address = {.seed = 48};
    int points = hard_points(1000000);
    double ours = 0, low_bits = 0;
    for (int i = 0; i < points; i += 4) {
        double uniform[4];
        random_uniform(&address, RANDOM_POINTERS, (uint32_t)i, uniform);
        for (int k = 0; k < 4; k++) {
            double counted = uniform[k] * 0x1p53;
            ours += !(uniform[k] > 0 && uniform[k] < 1) || fmod(counted, 2) != 1;
            low_bits += fmod(counted, 4) == 1;
        }
    }
    ours += fabs(low_bits / points - 0.5) > 2.5 / sqrt(points);
    hard_case("48", "uniform draws outside (0, 1), or not of 52 bits", "wrong", count_plain_ends(),
              ours, 0);
}

/* Hard case 49: the reach sqrt(-2 log 2^-53) of the tail against that of 32-bit draws, which end at
 * 2^-33. */
TEST(the_tail_reaches_as_far_as_52_bits_let_it)
{
    uint32_t last = (uint32_t)hard_points(1000000);
    struct random_address address = {.seed = 49};
    double expected = sqrt(-2 * log(0x1p-53)), least = 1;
    for (uint32_t i = 0; i < last; i++)
        least = fmin(least, any_uniform(&address, i));
    /* The least of n uniform draws is beyond 20/n with probability e^-20. */
    assert_true(least < 20.0 / last);
    hard_case("49", "reach of the Gaussian tail cut off", "sigma",
              expected - sqrt(-2 * log(0x1p-33)), expected - sqrt(-2 * elementary_log(0x1p-53)),
              1e-15);
}

/* A Gaussian draw by Box and Muller with the C library, of the uniforms at the same address. */
static void exact_gaussian(mpfr_t result, double radius_draw, double angle_draw, bool sine)
{
    MPFR_DECL_INIT(angle, PRECISION);
    mpfr_set_d(angle, angle_draw, MPFR_RNDN);
    if (sine)
        mpfr_sinu(angle, angle, 1, MPFR_RNDN);
    else
        mpfr_cosu(angle, angle, 1, MPFR_RNDN);
    mpfr_set_d(result, radius_draw, MPFR_RNDN);
    mpfr_log(result, result, MPFR_RNDN);
    mpfr_mul_si(result, result, -2, MPFR_RNDN);
    mpfr_sqrt(result, result, MPFR_RNDN);
    mpfr_mul(result, result, angle, MPFR_RNDN);
}

TEST(gaussian_draws_are_exact_to_a_few_ulp)
{
    struct random_address address = {.seed = 53};
    int blocks = hard_points(25000);
    double naive = 0, ours = 0;
    MPFR_DECL_INIT(exact, PRECISION);
    for (int i = 0; i < blocks; i++) {
        double uniform[4], gaussian[4];
        random_uniform(&address, RANDOM_POINTERS, (uint32_t)i, uniform);
        random_gaussian(&address, RANDOM_POINTERS, (uint32_t)i, gaussian);
        for (int k = 0; k < 4; k++) {
            double radius_draw = uniform[k / 2 * 2], angle_draw = uniform[k / 2 * 2 + 1];
            double angle_rad = 2 * PI * angle_draw;
            double plain = sqrt(-2 * log(radius_draw)) * (k % 2 ? sin(angle_rad) : cos(angle_rad));
            exact_gaussian(exact, radius_draw, angle_draw, k % 2);
            naive = fmax(naive, error_ulp(plain, exact));
            ours = fmax(ours, error_ulp(gaussian[k], exact));
        }
    }
    hard_case("53", "Gaussian draw (naive: libm)", "ulp", naive, ours, 3);
}

enum { SCENES = 64 };

/* Hash of all targets of 64 scenes in the scenes' order, made in so many runs. */
static double hash_of_shards(int shards)
{
    uint64_t hash = HASH_START;
    for (int shard = 0; shard < shards; shard++) {
        int first = shard * SCENES / shards, end = (shard + 1) * SCENES / shards;
        struct hard_chain chain;
        hard_chain_start(&chain, first, end - first);
        for (int i = first; i < end; i++) {
            struct text *text = check_text();
            hard_chain_next(&chain);
            hard_chain_step(&chain, 1, CHAIN_STAGES - 1);
            /* Leaves out the end marker: it says where a run ends, not what is in the scene. */
            chain.frame.last = false;
            hard_chain_write(&chain, text);
            hash = hash_bytes(hash, text->bytes, text->length);
        }
        hard_chain_stop(&chain);
    }
    return (double)(hash >> 11);
}

/* Hash of 64 scenes that draw ten numbers each from one stream per run. */
static double hash_of_streams(int shards)
{
    uint64_t hash = HASH_START;
    for (int shard = 0; shard < shards; shard++) {
        uint64_t stream = (uint64_t)shard + 1;
        int first = shard * SCENES / shards, end = (shard + 1) * SCENES / shards;
        for (int i = 10 * first; i < 10 * end; i++) {
            uint64_t drawn = sample_bits(&stream);
            hash = hash_bytes(hash, &drawn, sizeof drawn);
        }
    }
    return (double)(hash >> 11);
}

TEST(shards_change_no_byte)
{
    static const int shards[] = {1, 2, 7, 64};
    double naive = 1, ours = 1;
    for (size_t i = 1; i < 4; i++) {
        naive += hash_of_streams(shards[i]) != hash_of_streams(1);
        ours += hash_of_shards(shards[i]) != hash_of_shards(1);
    }
    hard_case("50", "64 scenes in 1, 2, 7 and 64 shards", "results", naive, ours, 1);
}

static double correlation(const double *values, size_t count)
{
    double sum = 0;
    for (size_t i = 1; i < count; i++)
        sum += (values[i] - 0.5) * (values[i - 1] - 0.5) * 12;
    return fabs(sum / (double)(count - 1));
}

/* Hard case 51. Independent seeds have a correlation of 0.01 by chance, and of 0.04 in one of
 * 16,000 trials. */
TEST(neighbouring_seeds_are_independent)
{
    enum { SEEDS = 10000 };
    static double plain[SEEDS], ours[SEEDS];
    for (long seed = 0; seed < SEEDS; seed++) {
        srand48(seed + 1);
        plain[seed] = drand48();
        struct random_address address = {.seed = (uint64_t)seed + 1};
        ours[seed] = any_uniform(&address, 0);
    }
    hard_case("51", "correlation of 1e4 neighbouring seeds", "r", correlation(plain, SEEDS),
              correlation(ours, SEEDS), 0.04);
}

/* The upper 64 bits of a product. */
static uint64_t high_product(uint64_t a, uint64_t b)
{
    uint64_t low = (a & UINT32_MAX) * (b & UINT32_MAX);
    uint64_t middle = (a >> 32) * (b & UINT32_MAX) + (low >> 32);
    uint64_t other = (a & UINT32_MAX) * (b >> 32) + (middle & UINT32_MAX);
    return (a >> 32) * (b >> 32) + (middle >> 32) + (other >> 32);
}

/* Ten rounds of Philox4x64, written from the publication (Salmon et al., SC'11). */
static void philox(uint64_t c[4], uint64_t key, uint64_t other_key)
{
    const uint64_t one = UINT64_C(0xd2e7470ee14c6c93), other = UINT64_C(0xca5a826395121157);
    for (int round = 0; round < 10; round++) {
        uint64_t next[4] = {high_product(other, c[2]) ^ c[1] ^ key, other * c[2],
                            high_product(one, c[0]) ^ c[3] ^ other_key, one * c[0]};
        memcpy(c, next, sizeof next);
        key += UINT64_C(0x9e3779b97f4a7c15);
        other_key += UINT64_C(0xbb67ae8584caa73b);
    }
}

TEST(draws_are_philox_at_any_address)
{
    uint64_t random = 51;
    int points = hard_points(100000);
    double ours = 0;
    for (int i = 0; i < points; i++) {
        uint64_t words[5];
        for (int k = 0; k < 5; k++)
            words[k] = sample_word(&random);
        struct random_address address = {words[0], words[1], words[2], words[3], words[4]};
        uint32_t index = (uint32_t)sample_word(&random);
        uint64_t block[4] = {address.frame, address.sensor, address.item,
                             (uint64_t)RANDOM_AZIMUTH << 32 | index};
        double uniform[4];
        random_uniform(&address, RANDOM_AZIMUTH, index, uniform);
        philox(block, address.seed, address.scene);
        for (int k = 0; k < 4; k++)
            ours += uniform[k] * 0x1p53 != 2 * (double)(block[k] >> 12) + 1;
    }
    hard_case("51", "Philox4x64-10 at 1e5 addresses", "wrong", (double)NAN, ours, 0);
}

TEST(no_seed_is_bad)
{
    struct random_address address = {0};
    uint64_t shifted = 0;
    double naive = 0, ours = 0, before = 0;
    for (uint32_t i = 0; i < 1000; i++) {
        shifted ^= shifted << 13;
        shifted ^= shifted >> 7;
        shifted ^= shifted << 17;
        naive += shifted == 0;
        double drawn = any_uniform(&address, i);
        ours += drawn == before;
        before = drawn;
    }
    hard_case("52", "1,000 draws of seed 0 (naive: xorshift)", "wrong", naive, ours, 0);
}
