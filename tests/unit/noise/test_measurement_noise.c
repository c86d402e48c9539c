#include "check.h"

#include "base/units.h"
#include "noise/measurement_noise.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])
#define EVERY (EFFECT_BIT(EFFECT_COUNT) - 1)

static const struct selection everything = {.allowed = EVERY};

static const struct sensor radar = {
    .name = "s",
    .threshold = 2,
    .pointer_sigma = 0.5,
    .cell_range_m = 0.3,
    .cell_range_rate_mps = 0.5,
    .range_sigma_m = 0.02,
    .range_rate_sigma_mps = 0.05,
    .window_factor = 0.68,
};

static const struct random_address address = {.seed = 1, .item = 2};

static struct measurement read_cell(const struct measurement_noise *by, const struct cell *cell)
{
    struct measurement measurement = target_list_measure(cell);
    measurement_noise_range(by, &address, &measurement);
    measurement_noise_azimuth(by, &measurement);
    return measurement;
}

static void what_no_member_describes_is_not_there(void **state)
{
    (void)state;
    const struct sensor silent = {.name = "s"};
    struct measurement_noise by = measurement_noise_of(&silent, &everything);
    assert_false(by.pointers || by.range || by.accuracy || by.misalignment || by.final_threshold ||
                 by.steps);
    assert_close(by.false_alarms, 0, 0);
    assert_int_equal(by.list_limit, 0);
    struct cell cell = {.range_m = 10, .azimuth_rad = 0.1, .range_rate_mps = -3, .amplitude = 4};
    struct measurement measurement = read_cell(&by, &cell);
    assert_close(measurement.range_m, 10, 0);
    assert_close(measurement.azimuth_rad, 0.1, 0);
    assert_close(measurement.range_rate_mps, -3, 0);
    assert_int_equal(measurement.effects, 0);
    struct antenna_pointers pointers =
        measurement_noise_pointers(&by, &address, &(struct cell){.sum_re = 3, .delta_re = 1});
    assert_true(pointers.sum == 3 && pointers.delta == 1);
}

static void what_is_not_selected_is_not_there(void **state)
{
    (void)state;
    struct sensor loud = radar;
    loud.sigma_law = SIGMA_BY_SNR;
    loud.misalignment_rad = 0.1;
    loud.false_alarms = 3;
    loud.list_limit = 5;
    loud.final_threshold = true;
    loud.range_step_m = 1;
    struct selection nothing = {0};
    struct measurement_noise by = measurement_noise_of(&loud, &nothing);
    assert_false(by.pointers || by.range || by.accuracy || by.misalignment || by.final_threshold ||
                 by.steps);
    assert_close(by.false_alarms, 0, 0);
    assert_int_equal(by.list_limit, 0);
    by = measurement_noise_of(&loud, &everything);
    assert_true(by.pointers && by.range && by.accuracy && by.misalignment && by.final_threshold &&
                by.steps);
    assert_close(by.false_alarms, 3, 0);
    assert_int_equal(by.list_limit, 5);
}

/* EFFECTS 3: (window_factor cell)^2 / snr + floor^2, at most cell^2 / 12. */
static void deviations_follow_the_law_of_the_sensor(void **state)
{
    (void)state;
    static const struct {
        enum sigma_law law;
        double amplitude, range_m, range_rate_mps;
    } cases[] = {
        {SIGMA_FIXED, 8, 0.02, 0.05},
        {SIGMA_BY_AMPLITUDE, 8, 0.005, 0.0125},
        {SIGMA_BY_AMPLITUDE, 1, 0.02, 0.05},
        {SIGMA_BY_SNR, 5, 0.028568514137070553, 0.0604648658313239},
        {SIGMA_BY_SNR, 0.05, 0.08660254037844387, 0.14433756729740646},
        {SIGMA_BY_SNR, 0, 0.08660254037844387, 0.14433756729740646},
        {SIGMA_BY_SNR, 1e300, 0.02, 0.05},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct sensor sensor = radar;
        sensor.sigma_law = cases[i].law;
        struct measurement_noise by = measurement_noise_of(&sensor, &everything);
        struct deviation sigma =
            measurement_noise_deviation(&by, &(struct cell){.amplitude = cases[i].amplitude});
        assert_near(sigma.range_m, cases[i].range_m, 1e-12);
        assert_near(sigma.range_rate_mps, cases[i].range_rate_mps, 1e-12);
    }
}

static void without_noise_on_the_pointers_only_the_floor_is_left(void **state)
{
    (void)state;
    struct sensor quiet = radar;
    quiet.sigma_law = SIGMA_BY_SNR;
    quiet.pointer_sigma = 0;
    struct measurement_noise by = measurement_noise_of(&quiet, &everything);
    struct deviation sigma = measurement_noise_deviation(&by, &(struct cell){.amplitude = 4});
    assert_near(sigma.range_m, 0.02, 1e-15);
    assert_near(sigma.range_rate_mps, 0.05, 1e-15);
}

static void accuracy_scales_the_same_draws(void **state)
{
    (void)state;
    struct sensor fixed = radar, by_snr = radar;
    by_snr.sigma_law = SIGMA_BY_SNR;
    struct cell cell = {.range_m = 10, .amplitude = 5};
    struct measurement_noise plain = measurement_noise_of(&fixed, &everything);
    struct measurement_noise better = measurement_noise_of(&by_snr, &everything);
    struct measurement one = read_cell(&plain, &cell), other = read_cell(&better, &cell);
    struct deviation sigma = measurement_noise_deviation(&better, &(struct cell){.amplitude = 5});
    assert_true(one.range_m != 10);
    assert_near(other.range_m - 10, (one.range_m - 10) * sigma.range_m / 0.02, 1e-12);
    assert_near(other.range_rate_mps, one.range_rate_mps * sigma.range_rate_mps / 0.05, 1e-14);
    assert_int_equal(one.effects, EFFECT_BIT(EFFECT_RANGE_NOISE));
    assert_int_equal(other.effects, EFFECT_BIT(EFFECT_RANGE_NOISE) | EFFECT_BIT(EFFECT_ACCURACY));
}

static void a_misaligned_sensor_turns_what_it_reports(void **state)
{
    (void)state;
    static const struct {
        double error_rad, bias_rad, azimuth_rad, reported_rad;
    } cases[] = {{0.02, 0, 0.1, 0.12},
                 {-0.02, 0, -1.5, -1.52},
                 {0, 0.01, 0.125, 0.135},
                 {0.02, 0.01, -0.125, -0.115},
                 {0.5, 0, 3, 3.5 - 2 * PI}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        const struct sensor sensor = {.misalignment_rad = cases[i].error_rad,
                                      .radome_bias_rad = cases[i].bias_rad,
                                      .radome_period_rad = 0.5};
        struct measurement_noise by = measurement_noise_of(&sensor, &everything);
        struct cell cell = {.azimuth_rad = cases[i].azimuth_rad};
        struct measurement measurement = read_cell(&by, &cell);
        assert_close(measurement.azimuth_rad, cases[i].reported_rad, 1e-15);
        assert_int_equal(measurement.effects, EFFECT_BIT(EFFECT_MISALIGNMENT));
    }
}

static void a_bias_that_is_zero_at_boresight_marks_nothing_there(void **state)
{
    (void)state;
    const struct sensor sensor = {.radome_bias_rad = 0.01, .radome_period_rad = 0.5};
    struct measurement_noise by = measurement_noise_of(&sensor, &everything);
    struct cell cell = {.azimuth_rad = 0};
    assert_int_equal(read_cell(&by, &cell).effects, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_no_member_describes_is_not_there),
        cmocka_unit_test(what_is_not_selected_is_not_there),
        cmocka_unit_test(deviations_follow_the_law_of_the_sensor),
        cmocka_unit_test(without_noise_on_the_pointers_only_the_floor_is_left),
        cmocka_unit_test(accuracy_scales_the_same_draws),
        cmocka_unit_test(a_misaligned_sensor_turns_what_it_reports),
        cmocka_unit_test(a_bias_that_is_zero_at_boresight_marks_nothing_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
