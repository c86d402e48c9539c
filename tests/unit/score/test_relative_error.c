#include "check.h"

#include <stdbool.h>

#include "base/random.h"
#include "score/relative_error.h"

enum { SEEDS = 4, ALL = 2 * SEEDS, BLOCKS = 10, SCANS = 20 };

/* Lists of one target that is there or not, and 1 apart if they differ: with the chances p and q
 * the energy distance is 2 (p - q)^2. One draw each for the lists of reference and chain. */
static void add_scan(double *distance, double p, double q, const double uniform[ALL])
{
    bool there[ALL];
    for (int i = 0; i < ALL; i++)
        there[i] = uniform[i] < (i < SEEDS ? p : q);
    for (int i = 0; i < ALL; i++)
        for (int k = 0; k < ALL; k++)
            distance[i * ALL + k] += (there[i] != there[k]) / (double)SCANS;
}

struct trial {
    double chain[BLOCKS * ALL * ALL], ideal[BLOCKS * ALL * ALL], weight[BLOCKS];
};

/* Blocks that differ: the reference lists the target with a p between 0.1 and 0.3, the chain with
 * p + 0.1 or p + 0.3, the ideal with p + 0.6. The error is the mean of 0.1^2 and 0.3^2 over 0.6^2.
 */
#define TRUE_ERROR (0.05 / 0.36)

static void draw(struct trial *trial, uint64_t number)
{
    *trial = (struct trial){0};
    struct random_sequence draws =
        random_sequence_at((struct random_address){.item = number}, RANDOM_TRAFFIC);
    for (int block = 0; block < BLOCKS; block++) {
        trial->weight[block] = 1.0 / BLOCKS;
        double p = random_sequence_between(&draws, 0.1, 0.3);
        double off = random_sequence_chance(&draws, 0.5) ? 0.1 : 0.3;
        for (int scan = 0; scan < SCANS; scan++) {
            double uniform[ALL];
            for (int i = 0; i < ALL; i++)
                uniform[i] = random_sequence_next(&draws);
            add_scan(trial->chain + block * ALL * ALL, p, p + off, uniform);
            add_scan(trial->ideal + block * ALL * ALL, p, p + 0.6, uniform);
        }
    }
}

static struct energy_blocks blocks_of(const double *distance, const struct trial *trial)
{
    return (struct energy_blocks){distance, trial->weight, BLOCKS, SEEDS, SEEDS};
}

static void ideal_echoes_have_an_error_of_exactly_1(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct trial trial;
    draw(&trial, 1);
    struct energy_blocks ideal = blocks_of(trial.ideal, &trial);
    struct relative_error error = relative_error_of(&ideal, &ideal, &arena);
    assert_close(error.value, 1, 0);
    assert_close(error.low, 1, 1e-12);
    assert_close(error.high, 1, 1e-12);
    arena_free(&arena);
}

/* 0 and 1 apart, in one block: 2 x 1 - 0 - 0 and 2 x 0.5 - 0 - 2/3 by the definition. */
static void the_error_is_the_ratio_of_energy_distances(void **state)
{
    (void)state;
    struct arena arena = {0};
    double chain[ALL * ALL] = {0}, ideal[ALL * ALL] = {0}, one = 1;
    const int half[ALL] = {0, 0, 0, 0, 0, 0, 1, 1}, other[ALL] = {0, 0, 0, 0, 1, 1, 1, 1};
    for (int i = 0; i < ALL; i++)
        for (int k = 0; k < ALL; k++) {
            chain[i * ALL + k] = half[i] != half[k];
            ideal[i * ALL + k] = other[i] != other[k];
        }
    struct energy_blocks of_chain = {chain, &one, 1, SEEDS, SEEDS};
    struct energy_blocks of_ideal = {ideal, &one, 1, SEEDS, SEEDS};
    assert_near(relative_error_of(&of_ideal, NULL, &arena).value, 2.0, 1e-15);
    assert_near(relative_error_of(&of_chain, NULL, &arena).value, 1.0 / 3, 1e-15);
    assert_near(relative_error_of(&of_chain, &of_ideal, &arena).value, 1.0 / 6, 1e-15);
    assert_near(relative_error_added(&of_ideal, &of_chain, &of_ideal, &arena).value, 5.0 / 6,
                1e-15);
    arena_free(&arena);
}

/* The mean over blocks is by weight: of the errors 1 and 0, with D of the ideal 2 in both. */
static void blocks_count_by_their_weight(void **state)
{
    (void)state;
    struct arena arena = {0};
    double chain[2 * ALL * ALL] = {0}, ideal[2 * ALL * ALL] = {0};
    for (int i = 0; i < 2 * ALL * ALL; i++) {
        int at = i % (ALL * ALL);
        ideal[i] = (at / ALL < SEEDS) != (at % ALL < SEEDS);
        chain[i] = i < ALL * ALL ? ideal[i] : 0;
    }
    const double weight[] = {0.75, 0.25};
    struct energy_blocks of_chain = {chain, weight, 2, SEEDS, SEEDS};
    struct energy_blocks of_ideal = {ideal, weight, 2, SEEDS, SEEDS};
    assert_near(relative_error_of(&of_chain, &of_ideal, &arena).value, 0.75, 1e-15);
    arena_free(&arena);
}

/* In 7 of 10 blocks neither the reference nor ideal echoes list anything, and 28 in 1,000 resamples
 * have only these. The other blocks have the errors 0, 0.5 and 1, so the ends of the interval are
 * equally far from 0.5. */
static void blocks_that_are_empty_have_no_ratio(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct trial trial = {0};
    for (int i = 0; i < BLOCKS * ALL * ALL; i++) {
        int block = i / (ALL * ALL), at = i % (ALL * ALL);
        bool apart = (at / ALL < SEEDS) != (at % ALL < SEEDS);
        trial.ideal[i] = block < 3 && apart;
        trial.chain[i] = trial.ideal[i] * block / 2;
        trial.weight[block] = 1.0 / BLOCKS;
    }
    struct energy_blocks chain = blocks_of(trial.chain, &trial);
    struct energy_blocks ideal = blocks_of(trial.ideal, &trial);
    struct relative_error error = relative_error_of(&chain, &ideal, &arena);
    assert_true(relative_error_of(&ideal, NULL, &arena).low > 0);
    assert_near(error.value, 0.5, 1e-15);
    assert_near(error.high - 0.5, 0.5 - error.low, 1e-12);
    arena_free(&arena);
}

/* Nominally 95 %. */
static void the_interval_covers_the_true_error(void **state)
{
    (void)state;
    enum { TRIALS = 300 };
    int covered = 0, too_low = 0;
    for (int i = 0; i < TRIALS; i++) {
        struct arena arena = {0};
        struct trial trial;
        draw(&trial, (uint64_t)i);
        struct energy_blocks chain = blocks_of(trial.chain, &trial);
        struct energy_blocks ideal = blocks_of(trial.ideal, &trial);
        struct relative_error error = relative_error_of(&chain, &ideal, &arena);
        covered += error.low <= TRUE_ERROR && error.high >= TRUE_ERROR;
        too_low += error.value < TRUE_ERROR;
        arena_free(&arena);
    }
    assert_true(covered >= 0.92 * TRIALS);
    assert_true(covered < TRIALS);
    assert_in_range(too_low, 0.4 * TRIALS, 0.6 * TRIALS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ideal_echoes_have_an_error_of_exactly_1),
        cmocka_unit_test(the_error_is_the_ratio_of_energy_distances),
        cmocka_unit_test(blocks_count_by_their_weight),
        cmocka_unit_test(blocks_that_are_empty_have_no_ratio),
        cmocka_unit_test(the_interval_covers_the_true_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
