#include "support/effect_bench.h"

static struct contributor leader = {.id = {.object = "o", .reflector = "r"}};

static void prepare(struct effect_bench *bench)
{
    bench->sensor.threshold_db = units_amplitude_db(2);
    bench->sensor.pointer_sigma = 0.5;
    bench->sensor.cell_range_m = 0.3;
    bench->sensor.cell_range_rate_mps = 0.5;
    bench->sensor.range_sigma_m = 0.02;
    bench->sensor.range_rate_sigma_mps = 0.05;
    bench->sensor.window_factor = 0.68;
}

static struct effect_measurement measure_cell(struct effect_bench *bench, uint64_t effects,
                                              double amplitude, double interference)
{
    struct cell *cell = arena_get(check_arena(), sizeof *cell);
    *cell = (struct cell){.range_m = 10,
                          .amplitude = amplitude,
                          .interference = interference,
                          .members = {&leader, 1, 1}};
    struct effect_scan scan = effect_bench_begin(bench, effects, EFFECT_HOME_NOISE);
    struct effect_measurement read = effect_measurement_of(&scan, cell);
    effect_measure(&scan, EFFECT_STEP_NOISE, &read);
    return read;
}

/* by_snr: sigma^2 = (window_factor cell)^2 / snr + floor^2, at most cell^2 / 12. */
EFFECT_TEST(sigmas_follow_the_law_of_the_sensor)
{
    static const struct {
        enum sigma_law law;
        double amplitude, interference, range_m, range_rate_mps;
    } cases[] = {
        {SIGMA_FIXED, 8, 0, 0.02, 0.05},
        {SIGMA_BY_AMPLITUDE, 8, 0, 0.005, 0.0125},
        {SIGMA_BY_AMPLITUDE, 8, 3, 0.01, 0.025},
        {SIGMA_BY_AMPLITUDE, 1, 0, 0.02, 0.05},
        {SIGMA_BY_SNR, 5, 0, 0.028568514137070553, 0.0604648658313239},
        {SIGMA_BY_SNR, 10, 3, 0.028568514137070553, 0.0604648658313239},
        {SIGMA_BY_SNR, 0.05, 0, 0.08660254037844387, 0.14433756729740646},
        {SIGMA_BY_SNR, 0, 0, 0.08660254037844387, 0.14433756729740646},
        {SIGMA_BY_SNR, 1e300, 0, 0.02, 0.05},
    };
    prepare(bench);
    for (size_t i = 0; i < COUNT(cases); i++) {
        bench->sensor.sigma_law = cases[i].law;
        struct effect_measurement read =
            measure_cell(bench, EVERY_EFFECT, cases[i].amplitude, cases[i].interference);
        assert_near(read.range_sigma_m, cases[i].range_m, 1e-12);
        assert_near(read.range_rate_sigma_mps, cases[i].range_rate_mps, 1e-12);
    }
}

EFFECT_TEST(without_noise_on_the_pointers_sigmas_are_their_floor)
{
    prepare(bench);
    bench->sensor.sigma_law = SIGMA_BY_SNR;
    bench->sensor.pointer_sigma = 0;
    struct effect_measurement read = measure_cell(bench, EVERY_EFFECT, 4, 0);
    assert_near(read.range_sigma_m, 0.02, 1e-15);
    assert_near(read.range_rate_sigma_mps, 0.05, 1e-15);
}

EFFECT_TEST(accuracy_scales_the_same_draws)
{
    prepare(bench);
    bench->sensor.sigma_law = SIGMA_BY_SNR;
    uint64_t without = EVERY_EFFECT & ~EFFECT_BIT(EFFECT_ACCURACY);
    struct effect_measurement fixed = measure_cell(bench, without, 5, 0);
    struct effect_measurement by_snr = measure_cell(bench, EVERY_EFFECT, 5, 0);
    assert_true(fixed.range_m != 10);
    assert_near(by_snr.range_m - 10, (fixed.range_m - 10) * 0.028568514137070553 / 0.02, 1e-12);
    assert_near(by_snr.range_rate_mps, fixed.range_rate_mps * 0.0604648658313239 / 0.05, 1e-13);
    assert_true(fixed.effects == EFFECT_BIT(EFFECT_RANGE_NOISE));
    assert_true(by_snr.effects == (EFFECT_BIT(EFFECT_RANGE_NOISE) | EFFECT_BIT(EFFECT_ACCURACY)));
}

EFFECT_TEST(without_range_noise_accuracy_changes_nothing)
{
    prepare(bench);
    bench->sensor.sigma_law = SIGMA_BY_SNR;
    uint64_t without = EVERY_EFFECT & ~EFFECT_BIT(EFFECT_RANGE_NOISE);
    struct effect_measurement read = measure_cell(bench, without, 5, 0);
    assert_true(read.range_m == 10 && read.range_rate_mps == 0 && read.effects == 0);
}
