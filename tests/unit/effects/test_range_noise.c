#include "support/effect_bench.h"

static struct contributor leader = {.id = {.object = "o", .reflector = "r"}};

static struct effect_measurement measure_cell(struct effect_bench *bench, const struct cell *cell)
{
    struct effect_scan scan = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE);
    struct effect_measurement read = effect_measurement_of(&scan, cell);
    effect_measure(&scan, EFFECT_STEP_NOISE, &read);
    return read;
}

EFFECT_TEST(range_and_rate_get_the_noise_of_their_cell)
{
    const struct cell cell = {.range_m = 10, .range_rate_mps = -3, .members = {&leader, 1, 1}};
    bench->sensor.range_sigma_m = 0.02;
    bench->sensor.range_rate_sigma_mps = 0.05;
    for (bench->frame.frame = 0; bench->frame.frame < 20; bench->frame.frame++) {
        struct random_address address = frame_draw_address_of(&bench->frame, "radar", leader.id);
        double draw[2];
        random_gaussian_pair(&address, RANDOM_RANGE_RATE, 0, draw);
        struct effect_measurement read = measure_cell(bench, &cell);
        assert_close(read.range_m, 10 + 0.02 * draw[0], 1e-15);
        assert_close(read.range_rate_mps, -3 + 0.05 * draw[1], 1e-15);
        assert_true(read.azimuth_rad == 0);
        assert_true(read.effects == EFFECT_BIT(EFFECT_RANGE_NOISE));
    }
}

EFFECT_TEST(the_larger_of_a_deviation_and_a_share_of_the_range_holds)
{
    struct cell cell = {.members = {&leader, 1, 1}};
    bench->sensor.range_sigma_m = 0.3;
    bench->sensor.range_sigma_share = 0.01;
    struct random_address address = frame_draw_address_of(&bench->frame, "radar", leader.id);
    double draw[2];
    random_gaussian_pair(&address, RANDOM_RANGE_RATE, 0, draw);
    for (cell.range_m = 10; cell.range_m < 100; cell.range_m += 10) {
        double sigma_m = cell.range_m > 30 ? cell.range_m / 100 : 0.3;
        struct effect_measurement read = measure_cell(bench, &cell);
        assert_close(read.range_sigma_m, sigma_m, 1e-15);
        assert_close(read.range_m, cell.range_m + sigma_m * draw[0], 1e-13);
    }
}

EFFECT_TEST(no_range_is_below_0)
{
    const struct cell cell = {.range_m = 0.1, .members = {&leader, 1, 1}};
    size_t cut = 0;
    bench->sensor.range_sigma_m = 1;
    for (bench->frame.frame = 0; bench->frame.frame < 100; bench->frame.frame++) {
        struct effect_measurement read = measure_cell(bench, &cell);
        assert_true(read.range_m >= 0);
        cut += read.range_m == 0;
    }
    assert_in_range(cut, 30, 65);
}
