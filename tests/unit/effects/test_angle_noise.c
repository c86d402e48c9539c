#include "support/effect_bench.h"

#include <complex.h>

/* Each channel gets complex noise of RMS pointer_sigma: four Gaussian draws, times
 * pointer_sigma sqrt(1/2) on each axis. Other radars with three times the noise's power double it.
 */
EFFECT_TEST(both_channels_get_the_noise_of_their_cell)
{
    struct contributor leader = {.id = {.object = "o", .reflector = "r"}};
    static const double interference[] = {0, 3};
    bench->sensor.pointer_sigma = 0.5;
    for (size_t i = 0; i < COUNT(interference); i++) {
        const struct cell cell = {.sum_re = 3,
                                  .delta_im = -1,
                                  .interference = interference[i],
                                  .members = {&leader, 1, 1}};
        struct effect_scan scan = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE);
        struct effect_measurement read = effect_measurement_of(&scan, &cell);
        struct random_address address = frame_draw_address_of(&bench->frame, "radar", leader.id);
        double draw[4], sigma = 0.5 * sqrt(0.5) * sqrt(1 + interference[i]);
        random_gaussian(&address, RANDOM_POINTERS, 0, draw);
        effect_measure(&scan, EFFECT_STEP_POINTERS, &read);
        assert_close(creal(read.pointers.sum), 3 + sigma * draw[0], 1e-15);
        assert_close(cimag(read.pointers.sum), sigma * draw[1], 1e-15);
        assert_close(creal(read.pointers.delta), sigma * draw[2], 1e-15);
        assert_close(cimag(read.pointers.delta), -1 + sigma * draw[3], 1e-15);
        assert_true(read.effects == EFFECT_BIT(EFFECT_ANGLE_NOISE));
    }
}

/* pi - 0.001 and a floor of 0.5 rad go beyond half a turn in half of the draws. */
EFFECT_TEST(the_floor_is_a_draw_of_its_own_on_the_azimuth_that_was_read)
{
    struct contributor leader = {.id = {.object = "o", .reflector = "r"}};
    const struct cell cell = {.range_m = 10, .members = {&leader, 1, 1}};
    bench->sensor.azimuth_floor_rad = 0.5;
    for (bench->frame.frame = 0; bench->frame.frame < 20; bench->frame.frame++) {
        struct random_address address = frame_draw_address_of(&bench->frame, "radar", leader.id);
        struct effect_scan scan = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE);
        struct effect_measurement read = effect_measurement_of(&scan, &cell);
        double draw[2];
        random_gaussian_pair(&address, RANDOM_AZIMUTH, 0, draw);
        read.azimuth_rad = PI - 0.001;
        effect_measure(&scan, EFFECT_STEP_NOISE, &read);
        assert_close(read.azimuth_rad, units_wrap_rad(PI - 0.001 + 0.5 * draw[0]), 1e-15);
        assert_true(read.range_m == 10 && read.effects == EFFECT_BIT(EFFECT_ANGLE_NOISE));
    }
}

EFFECT_TEST(without_the_effect_pointers_are_those_of_the_cell)
{
    struct contributor leader = {.id = {.object = "o", .reflector = "r"}};
    const struct cell cell = {.sum_re = 3, .delta_re = 1, .members = {&leader, 1, 1}};
    bench->sensor.pointer_sigma = 0.5;
    uint64_t without = EVERY_EFFECT & ~EFFECT_BIT(EFFECT_ANGLE_NOISE);
    struct effect_scan scan = effect_bench_begin(bench, without, EFFECT_HOME_NOISE);
    struct effect_measurement read = effect_measurement_of(&scan, &cell);
    effect_measure(&scan, EFFECT_STEP_POINTERS, &read);
    assert_true(read.pointers.sum == 3 && read.pointers.delta == 1 && read.effects == 0);
}
