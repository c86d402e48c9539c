#include "check.h"

#include "base/random.h"
#include "score/relative_error.h"

enum { SEEDS = 6, ALL = 2 * SEEDS, SCANS = 20 };

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
    double chain[ALL * ALL], ideal[ALL * ALL];
};

/* The reference lists the target with a chance of 0.2, the chain with so much more, the ideal with
 * 0.6 more. */
static struct trial draw(double more, uint64_t number)
{
    struct trial trial = {0};
    struct random_sequence draws =
        random_sequence_at((struct random_address){.item = number}, RANDOM_TRAFFIC);
    for (int scan = 0; scan < SCANS; scan++) {
        double uniform[ALL];
        for (int i = 0; i < ALL; i++)
            uniform[i] = random_sequence_next(&draws);
        add_scan(trial.chain, 0.2, 0.2 + more, uniform);
        add_scan(trial.ideal, 0.2, 0.8, uniform);
    }
    return trial;
}

static struct energy_sample lists_of(const double *distance)
{
    return (struct energy_sample){distance, SEEDS, SEEDS};
}

TEST(ideal_echoes_have_an_error_of_exactly_1)
{
    struct trial trial = draw(0.1, 1);
    struct energy_sample ideal = lists_of(trial.ideal);
    struct relative_error error = relative_error_of(&ideal, &ideal);
    assert_close(error.value, 1, 0);
    assert_close(error.low, 1, 1e-12);
    assert_close(error.high, 1, 1e-12);
}

/* 0 and 1 apart: 2 x 1 - 0 - 0 and 2 x 0.5 - 0 - 3/5 by the definition. */
TEST(the_squared_error_is_the_ratio_of_energy_distances)
{
    double chain[ALL * ALL] = {0}, ideal[ALL * ALL] = {0};
    for (int i = 0; i < ALL; i++)
        for (int k = 0; k < ALL; k++) {
            chain[i * ALL + k] = (i < 9) != (k < 9);
            ideal[i * ALL + k] = (i < SEEDS) != (k < SEEDS);
        }
    struct energy_sample of_chain = lists_of(chain), of_ideal = lists_of(ideal);
    assert_near(relative_error_of(&of_ideal, NULL).value, 2.0, 1e-15);
    assert_near(relative_error_of(&of_chain, NULL).value, 0.4, 1e-15);
    assert_near(relative_error_of(&of_chain, &of_ideal).value, 0.2, 1e-15);
    assert_near(relative_error_added(&of_ideal, &of_chain, &of_ideal, check_arena()).value, 0.8,
                1e-15);
}

/* Numbers as lists: the deviation is that of ratios that are made again without each list, and the
 * interval that of Student's t, 2.2281 for 10 degrees of freedom of two equal laws. */
TEST(the_deviation_is_that_of_the_jackknife)
{
    const double place[ALL] = {0.3, 1.2, -0.4, 2.2, 0.9, 1.5};
    double distance[ALL * ALL], values[ALL], mean = 0, squares = 0;
    for (int i = 0; i < ALL; i++)
        for (int k = 0; k < ALL; k++)
            distance[i * ALL + k] =
                fabs(place[i % SEEDS] - place[k % SEEDS]) + (i / SEEDS != k / SEEDS);
    struct energy_sample sample = lists_of(distance);
    for (int out = 0; out < SEEDS; out++) {
        values[out] = energy_distance_without(&sample, (size_t)out);
        mean += values[out] / SEEDS;
    }
    for (int i = 0; i < SEEDS; i++)
        squares += (values[i] - mean) * (values[i] - mean);
    struct relative_error found = relative_error_of(&sample, NULL);
    assert_near(found.deviation, sqrt(2 * squares * (SEEDS - 1) / SEEDS), 1e-12);
    assert_close((found.high - found.value) / found.deviation, 2.2281, 0.002);
    assert_near(found.high - found.value, found.value - found.low, 1e-12);
}

TEST(the_root_stands_above_0)
{
    static const struct relative_error squares[] = {
        {0.09, 0.04, 0.14, 0}, {0.01, -0.03, 0.05, 0}, {-0.02, -0.05, 0.01, 0}};
    static const double roots[][3] = {{0.3, 0.2, 0.37416573867739417},
                                      {0.1, 0, 0.22360679774997896},
                                      {0, 0, 0.17320508075688773}};
    for (size_t i = 0; i < 3; i++) {
        struct relative_error root = relative_error_root(squares[i]);
        assert_close(root.value, roots[i][0], 1e-15);
        assert_close(root.low, roots[i][1], 1e-15);
        assert_close(root.high, roots[i][2], 1e-15);
    }
}

/* Nominally 95 %; more where chain and reference have one law, as the jackknife errs upwards. */
TEST(the_interval_covers_the_true_error)
{
    enum { TRIALS = 300 };
    for (double more = 0; more <= 0.4; more += 0.1) {
        double truth = more * more / 0.36;
        int covered = 0;
        for (int i = 0; i < TRIALS; i++) {
            struct trial trial = draw(more, (uint64_t)i);
            struct energy_sample chain = lists_of(trial.chain), ideal = lists_of(trial.ideal);
            struct relative_error error = relative_error_of(&chain, &ideal);
            covered += error.low <= truth && error.high >= truth;
        }
        assert_in_range(covered, 0.92 * TRIALS, TRIALS);
        assert_true(more == 0 || covered < TRIALS);
    }
}
