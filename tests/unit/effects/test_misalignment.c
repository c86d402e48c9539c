#include "support/effect_bench.h"

static struct effect_measurement turn(struct effect_bench *bench, double azimuth_rad)
{
    struct effect_scan scan = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE);
    struct effect_measurement read = {.azimuth_rad = azimuth_rad};
    effect_measure(&scan, EFFECT_STEP_ANGLES, &read);
    return read;
}

EFFECT_TEST(a_misaligned_sensor_turns_what_it_reports)
{
    static const struct {
        double error_rad, bias_rad, azimuth_rad, reported_rad;
    } cases[] = {{0.02, 0, 0.1, 0.12},
                 {-0.02, 0, -1.5, -1.52},
                 {0, 0.01, 0.125, 0.135},
                 {0.02, 0.01, -0.125, -0.115},
                 {0.5, 0, 3, 3.5 - 2 * PI}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        bench->sensor.misalignment_rad = cases[i].error_rad;
        bench->sensor.radome_bias_rad = cases[i].bias_rad;
        bench->sensor.radome_period_rad = 0.5;
        struct effect_measurement read = turn(bench, cases[i].azimuth_rad);
        assert_close(read.azimuth_rad, cases[i].reported_rad, 1e-15);
        assert_true(read.effects == EFFECT_BIT(EFFECT_MISALIGNMENT));
    }
}

EFFECT_TEST(a_bias_that_is_zero_at_boresight_is_not_in_the_label_there)
{
    bench->sensor.radome_bias_rad = 0.01;
    bench->sensor.radome_period_rad = 0.5;
    assert_true(turn(bench, 0).effects == 0);
}
