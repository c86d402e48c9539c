#include "support/effect_bench.h"

#include <complex.h>

#include "base/elementary.h"
#include "noise/target_list.h"

static struct contributor leader = {.id = {.object = "o", .reflector = "r"}};

/* The cell of an echo of amplitude 4 at 0.1 rad. */
static struct cell cell_of(struct effect_bench *bench)
{
    struct antenna_pointers unit = antenna_pointers(&bench->sensor.antenna, 0.1);
    double gain = antenna_gain(&bench->sensor.antenna, 0.1);
    return (struct cell){.sensor = "radar",
                         .range_m = 30,
                         .azimuth_rad = 0.1,
                         .range_rate_mps = -3,
                         .amplitude = 4,
                         .sum_re = 4 / gain * creal(unit.sum),
                         .sum_im = 4 / gain * cimag(unit.sum),
                         .delta_re = 4 / gain * creal(unit.delta),
                         .delta_im = 4 / gain * cimag(unit.delta),
                         .effects = EFFECT_BIT(EFFECT_MERGING),
                         .members = {&leader, 1, 1}};
}

EFFECT_TEST(without_noise_a_measurement_has_the_values_of_its_cell)
{
    struct effect_scan context = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE);
    struct cell cell = cell_of(bench);
    struct effect_measurement read;
    assert_true(target_list_measure(&context, &cell, &read));
    assert_true(read.cell == &cell && read.range_m == 30 && read.range_rate_mps == -3);
    assert_close(read.azimuth_rad, 0.1, 1e-12);
    assert_near(read.amplitude, 4.0, 1e-12);
    assert_true(read.effects == EFFECT_BIT(EFFECT_MERGING));
}

EFFECT_TEST(angle_and_amplitude_are_those_of_the_noisy_pointers)
{
    struct sensor *sensor = &bench->sensor;
    sensor->pointer_sigma = 0.1;
    sensor->misalignment_rad = 0.02;
    struct effect_scan context = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE);
    struct cell cell = cell_of(bench);
    struct effect_measurement read;
    struct effect_measurement noisy = effect_measurement_of(&context, &cell);
    effect_measure(&context, EFFECT_STEP_POINTERS, &noisy);
    struct monopulse_angle angle =
        monopulse_angle(&sensor->antenna, sensor->angle_estimator, noisy.pointers);
    assert_true(target_list_measure(&context, &cell, &read));
    assert_true(fabs(angle.azimuth_rad - 0.1) > 1e-5);
    assert_close(read.azimuth_rad, angle.azimuth_rad + 0.02, 1e-15);
    assert_near(read.amplitude, cabs(noisy.pointers.sum), 1e-15);
    assert_true(read.effects ==
                (cell.effects | EFFECT_BIT(EFFECT_ANGLE_NOISE) | EFFECT_BIT(EFFECT_MISALIGNMENT)));
}

EFFECT_TEST(pointers_of_zero_have_no_angle)
{
    struct effect_scan context = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_NOISE);
    const struct cell cell = {.members = {&leader, 1, 1}};
    struct effect_measurement read;
    assert_false(target_list_measure(&context, &cell, &read));
}
