#include "support/effect_bench.h"

static struct effect_measurement reported(struct effect_bench *bench,
                                          struct effect_measurement exact)
{
    struct effect_scan scan = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE);
    effect_measure(&scan, EFFECT_STEP_ROUNDING, &exact);
    return exact;
}

EFFECT_TEST(values_are_rounded_to_their_steps_and_azimuth_is_wrapped)
{
    bench->sensor.range_step_m = 0.5;
    bench->sensor.range_rate_step_mps = 0.25;
    bench->sensor.azimuth_step_rad = 1.1;
    static const struct {
        double azimuth_rad, reported_rad;
    } cases[] = {{0.4, 0}, {-1, -1.1}, {3.1, 3.3 - 2 * PI}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct effect_measurement read =
            reported(bench, (struct effect_measurement){.range_m = 10.3,
                                                        .azimuth_rad = cases[i].azimuth_rad,
                                                        .range_rate_mps = -3.2});
        assert_close(read.range_m, 10.5, 0);
        assert_close(read.azimuth_rad, cases[i].reported_rad, 1e-15);
        assert_close(read.range_rate_mps, -3.25, 0);
    }
}

/* None of the three values is off its step, or one of them. */
EFFECT_TEST(a_change_of_any_value_is_in_the_label)
{
    bench->sensor.range_step_m = 0.5;
    bench->sensor.range_rate_step_mps = 0.25;
    bench->sensor.azimuth_step_rad = 0.125;
    static const struct {
        struct effect_measurement exact;
        bool labelled;
    } cases[] = {
        {{.range_m = 10.5, .azimuth_rad = 0.25, .range_rate_mps = -3.25}, false},
        {{.range_m = 10.6, .azimuth_rad = 0.25, .range_rate_mps = -3.25}, true},
        {{.range_m = 10.5, .azimuth_rad = 0.26, .range_rate_mps = -3.25}, true},
        {{.range_m = 10.5, .azimuth_rad = 0.25, .range_rate_mps = -3.26}, true},
    };
    for (size_t i = 0; i < COUNT(cases); i++)
        assert_true(reported(bench, cases[i].exact).effects ==
                    (cases[i].labelled ? EFFECT_BIT(EFFECT_QUANTISATION) : 0));
}

EFFECT_TEST(elevations_have_a_step_of_their_own)
{
    bench->sensor.elevation_step_rad = 0.125;
    struct effect_measurement read =
        reported(bench, (struct effect_measurement){.azimuth_rad = 0.26, .elevation_rad = -0.2});
    assert_close(read.elevation_rad, -0.25, 0);
    assert_close(read.azimuth_rad, 0.26, 0);
    assert_true(read.effects == EFFECT_BIT(EFFECT_QUANTISATION));
}

EFFECT_TEST(a_value_without_a_step_stays)
{
    bench->sensor.azimuth_step_rad = 0.125;
    struct effect_measurement read = reported(
        bench,
        (struct effect_measurement){.range_m = 10.3, .azimuth_rad = 0.26, .range_rate_mps = -3.2});
    assert_close(read.range_m, 10.3, 0);
    assert_close(read.range_rate_mps, -3.2, 0);
    assert_close(read.azimuth_rad, 0.25, 0);
    assert_true(read.effects == EFFECT_BIT(EFFECT_QUANTISATION));
}
