#include "support/effect_bench.h"

/* Power is exponential in Swerling's case 1, and the mean of two exponentials in case 3. */
EFFECT_TEST(the_factor_follows_the_draw_of_its_echo)
{
    struct echo echo = effect_bench_echo(100);
    double uniform[4];
    for (bench->frame.frame = 0; bench->frame.frame < 20; bench->frame.frame++) {
        effect_bench_draw(bench, &echo, effect_fluctuation.purposes[0], 0, uniform);
        bench->sensor.fluctuation = FLUCTUATION_SWERLING_1;
        assert_near(effect_bench_factor(bench, EFFECT_FLUCTUATION, &echo), sqrt(-log(uniform[0])),
                    1e-14);
        bench->sensor.fluctuation = FLUCTUATION_SWERLING_3;
        assert_near(effect_bench_factor(bench, EFFECT_FLUCTUATION, &echo),
                    sqrt(-(log(uniform[0]) + log(uniform[1])) / 2), 1e-14);
    }
}

EFFECT_TEST(another_echo_and_another_scan_have_other_factors)
{
    struct echo echo = effect_bench_echo(100), other = echo;
    other.id.reflector = "q";
    bench->sensor.fluctuation = FLUCTUATION_SWERLING_1;
    double first = effect_bench_factor(bench, EFFECT_FLUCTUATION, &echo);
    assert_close(effect_bench_factor(bench, EFFECT_FLUCTUATION, &echo), first, 0);
    assert_true(effect_bench_factor(bench, EFFECT_FLUCTUATION, &other) != first);
    bench->frame.frame = 1;
    assert_true(effect_bench_factor(bench, EFFECT_FLUCTUATION, &echo) != first);
}

EFFECT_TEST(a_spread_of_0_changes_nothing)
{
    struct echo echo = effect_bench_echo(100);
    bench->sensor.fluctuation = FLUCTUATION_LOG_NORMAL;
    bench->sensor.fluctuation_sigma_db = 0;
    assert_close(effect_bench_factor(bench, EFFECT_FLUCTUATION, &echo), 1, 0);
}

EFFECT_TEST(what_stands_beside_the_road_keeps_its_own_level)
{
    struct echo echo = effect_bench_echo(100);
    bench->sensor.fluctuation = FLUCTUATION_SWERLING_1;
    assert_true(effect_bench_factor(bench, EFFECT_FLUCTUATION, &echo) != 1);
    echo.effects = EFFECT_BIT(EFFECT_ROADSIDE);
    assert_close(effect_bench_factor(bench, EFFECT_FLUCTUATION, &echo), 1, 0);
}
