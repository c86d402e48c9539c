#include "support/effect_bench.h"

EFFECT_TEST(ranges_and_rates_beyond_the_unambiguous_ones_fold)
{
    static const struct {
        double limit_m, limit_mps, range_m, rate_mps, folded_m, folded_mps, middle_mps;
    } cases[] = {
        {60, 24.5, 100, 45, 40, -4, 0},     {60, 0, 100, 45, 40, 45, 0},
        {0, 24.5, 100, 45, 100, -4, 0},     {0, 24.5, 10, -60, 10, -11, 0},
        {60, 24.5, 59, 24, 59, 24, 0},      {60, 0, 150, -60, 30, -60, 0},
        {100.5, 45.5, 100, 45, 100, 45, 0}, {0, 24.5, 10, 45, 10, 45, 21},
        {0, 24.5, 10, -4, 10, 45, 21},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct echo echo = effect_bench_echo(cases[i].range_m);
        bool labelled;
        echo.range_rate_mps = cases[i].rate_mps;
        bench->sensor.unambiguous_range_m = cases[i].limit_m;
        bench->sensor.unambiguous_rate_mps = cases[i].limit_mps;
        bench->sensor.unambiguous_middle_mps = cases[i].middle_mps;
        struct effect_reception reception =
            effect_bench_receive(bench, EFFECT_AMBIGUITY, &echo, &labelled);
        assert_close(reception.range_m, cases[i].folded_m, 0);
        assert_close(reception.range_rate_mps, cases[i].folded_mps, 0);
        assert_true(reception.strength == 1 && reception.amplitude == 1);
        assert_true(labelled == (cases[i].folded_m != cases[i].range_m ||
                                 cases[i].folded_mps != cases[i].rate_mps));
    }
}
