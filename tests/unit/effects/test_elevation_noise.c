#include "support/effect_bench.h"

static struct contributor leader = {.id = {.object = "o", .reflector = "r"}};

static void prepare(struct effect_bench *bench)
{
    bench->sensor.threshold_db = units_amplitude_db(2);
    bench->sensor.mount_z_m = 0.5;
    bench->sensor.elevation_view_rad = 0.6;
    bench->sensor.elevation_sigma_rad = 0.03;
    bench->sensor.elevation_floor_rad = 0.004;
}

static struct effect_measurement measure_cell(struct effect_bench *bench, uint64_t effects,
                                              double amplitude, double interference)
{
    struct cell *cell = arena_get(check_arena(), sizeof *cell);
    *cell = (struct cell){.elevation_rad = 0.01,
                          .sum_re = amplitude,
                          .interference = interference,
                          .members = {&leader, 1, 1}};
    struct effect_scan scan = effect_bench_begin(bench, effects, EFFECT_HOME_NOISE);
    struct effect_measurement read = effect_measurement_of(&scan, cell);
    effect_measure(&scan, EFFECT_STEP_ANGLES, &read);
    return read;
}

/* sigma^2 = (0.03 * 2 sqrt(1 + interference)/amplitude)^2 + 0.004^2, at most 0.6^2/12. */
EFFECT_TEST(the_deviation_falls_with_the_amplitude_to_a_floor_and_rises_with_other_radars)
{
    static const struct {
        double amplitude, interference, sigma_rad;
    } cases[] = {
        {2, 0, 0.030265491900843113},
        {20, 0, 0.005},
        {40, 3, 0.005},
        {1e300, 0, 0.004},
        {0.1, 0, 0.17320508075688773},
        {0, 0, 0.17320508075688773},
    };
    prepare(bench);
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct effect_measurement read =
            measure_cell(bench, EVERY_EFFECT, cases[i].amplitude, cases[i].interference);
        double draw[2];
        random_gaussian_pair(&read.address, RANDOM_ELEVATION, 0, draw);
        assert_near(read.elevation_sigma_rad, cases[i].sigma_rad, 1e-12);
        assert_near(read.elevation_rad, 0.01 + cases[i].sigma_rad * draw[0], 1e-12);
        assert_true(read.effects == EFFECT_BIT(EFFECT_ELEVATION_NOISE));
    }
}

EFFECT_TEST(no_elevation_is_beyond_the_vertical)
{
    prepare(bench);
    bench->sensor.elevation_view_rad = PI;
    bench->sensor.elevation_floor_rad = PI / 2;
    bool met = false;
    for (int64_t number = 0; number < 30; number++) {
        leader.id.number = number;
        struct effect_measurement read = measure_cell(bench, EVERY_EFFECT, 2, 0);
        assert_true(fabs(read.elevation_rad) <= PI / 2);
        met |= fabs(read.elevation_rad) == PI / 2;
    }
    assert_true(met);
}

EFFECT_TEST(a_sensor_that_measures_elevation_without_figures_has_no_noise_on_it)
{
    prepare(bench);
    bench->sensor.elevation_sigma_rad = bench->sensor.elevation_floor_rad = 0;
    struct effect_measurement read = measure_cell(bench, EVERY_EFFECT, 2, 0);
    assert_true(read.elevation_rad == 0.01 && read.effects == 0);
    assert_true((bench->log.left_out & EFFECT_BIT(EFFECT_ELEVATION_NOISE)) != 0);
}
