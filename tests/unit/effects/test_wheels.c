#include "support/effect_bench.h"

enum { FRAMES = 300 };

static struct echo hub(void)
{
    struct echo echo = effect_bench_echo(20);
    echo.moving_part = MOVING_WHEEL;
    echo.ground_rate_mps = 5;
    echo.height_m = 0.3;
    echo.effects = EFFECT_BIT(EFFECT_VISIBILITY);
    return echo;
}

/* The least k with P(N <= k) >= uniform, for a Poisson count. */
static size_t poisson(double mean, double uniform)
{
    double chance = exp(-mean), sum = chance;
    size_t count = 0;
    for (; sum < uniform; sum += chance)
        chance *= mean / (double)++count;
    return count;
}

/* Points are a Poisson count of mean 1.5, at -10 dB, with rho uniform from 0.3 to 1 and psi uniform
 * around the wheel. */
EFFECT_TEST(points_have_the_count_and_the_rates_of_their_draws)
{
    size_t all = 0;
    for (bench->frame.frame = 0; bench->frame.frame < FRAMES; bench->frame.frame++) {
        const struct echo parent = hub();
        struct echo_span points = effect_bench_added(bench, EVERY_EFFECT, parent);
        double uniform[4];
        effect_bench_draw(bench, &parent, effect_wheels.purposes[0], 0, uniform);
        assert_int_equal(points.count, poisson(1.5, uniform[0]));
        for (size_t i = 0; i < points.count; i++) {
            const struct echo *point = &points.items[i];
            effect_bench_draw(bench, &parent, effect_wheels.purposes[0], (uint32_t)i + 1, uniform);
            double forward = (0.3 + 0.7 * uniform[0]) * cos(2 * PI * uniform[1]);
            assert_close(point->range_rate_mps, -3 + 5 * forward, 1e-13);
            assert_near(point->ercs, pow(10, -0.5), 1e-15);
            assert_true(point->range_m == 20 && point->azimuth_rad == 0 && point->height_m == 0.3);
            assert_int_equal(point->id.path, PATH_WHEEL);
            assert_int_equal(point->id.number, i + 1);
            assert_string_equal(point->id.object, "other");
            assert_true(point->effects ==
                        (EFFECT_BIT(EFFECT_VISIBILITY) | EFFECT_BIT(EFFECT_WHEELS)));
            assert_int_equal(point->moving_part, MOVING_NONE);
        }
        all += points.count;
    }
    assert_true(all > FRAMES);
}

EFFECT_TEST(a_wheel_that_does_not_roll_along_the_sight_line_has_no_points)
{
    struct echo still = hub(), limbs = hub(), plain = hub();
    still.ground_rate_mps = 0;
    limbs.moving_part = MOVING_LIMBS;
    plain.moving_part = MOVING_NONE;
    const struct echo echoes[] = {still, plain, limbs};
    for (bench->frame.frame = 0; bench->frame.frame < FRAMES; bench->frame.frame++)
        for (size_t i = 0; i < COUNT(echoes); i++) {
            uint64_t effects = EFFECT_BIT(EFFECT_WHEELS);
            assert_int_equal(effect_bench_added(bench, effects, echoes[i]).count, 0);
            assert_true(bench->log.simulated == 0);
        }
}

/* A parked car whose speed is the difference of two rounded places is the parked car of a scenario.
 */
EFFECT_TEST(points_fade_in_with_the_speed_and_none_is_made_of_rounding)
{
    double rates[] = {1e-300, 1e-12, -0.05, 0.050001, -0.275, 0.4999999, 0.5};
    double shares[] = {0, 0, 0, 1e-6 / 0.45, 0.5, 0.4499999 / 0.45, 1};
    size_t seen = 0;
    for (bench->frame.frame = 0; bench->frame.frame < 20; bench->frame.frame++)
        for (size_t i = 0; i < COUNT(rates); i++) {
            struct echo slow = hub();
            slow.ground_rate_mps = rates[i];
            struct echo_span points = effect_bench_added(bench, EFFECT_BIT(EFFECT_WHEELS), slow);
            for (size_t j = 0; j < points.count; j++)
                assert_close(points.items[j].ercs, shares[i] * pow(10, -0.5), 1e-15);
            assert_true(shares[i] > 0 || points.count == 0);
            seen += points.count;
        }
    assert_true(seen > 40);
}

EFFECT_TEST(without_the_effect_a_wheel_has_no_points)
{
    uint64_t without = EVERY_EFFECT & ~EFFECT_BIT(EFFECT_WHEELS);
    for (bench->frame.frame = 0; bench->frame.frame < FRAMES; bench->frame.frame++)
        assert_int_equal(effect_bench_added(bench, without, hub()).count, 0);
}
