#include "check.h"

#include "accuracy.h"
#include "antenna.h"
#include "sample.h"
#include "units.h"

#define DEGREE (PI / 180)
#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static const double CRAMER_RAO = 0.389848401;
static const double RULE_OF_THUMB = 0.70710678118654752;

static double snr_of(double db)
{
    return pow(10, db / 10);
}

static void effects_3_has_these_sigmas(void **state)
{
    (void)state;
    assert_close(sqrt(6) / (2 * PI), CRAMER_RAO, 5e-10);
    static const double range_m = 299792458.0 / 1e9;
    const struct {
        double cell, factor, snr_db, sigma;
    } cases[] = {
        {range_m, CRAMER_RAO, 6, 0.058576},
        {range_m, CRAMER_RAO, 13, 0.026165},
        {range_m, CRAMER_RAO, 20, 0.011687},
        {range_m, RULE_OF_THUMB, 13, 0.047458},
        {range_m, RULE_OF_THUMB, 20, 0.021199},
        {0.5, CRAMER_RAO, 13, 0.043638},
        {0.5, CRAMER_RAO, 20, 0.019492},
        /* 0.106244 without the bound, which is 0.299792 / sqrt 12 */
        {range_m, RULE_OF_THUMB, 6, 0.086543},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct accuracy accuracy = {.cell = cases[i].cell, .factor = cases[i].factor};
        assert_close(accuracy_sigma(&accuracy, snr_of(cases[i].snr_db)), cases[i].sigma, 5e-7);
    }
}

/* EFFECTS 15: steps of 0.2 m, 0.25 m/s and 0.1 deg alone. */
static void rounding_alone_has_the_sigma_of_effects_15(void **state)
{
    (void)state;
    static const double cases[][2] = {{0.2, 0.057735}, {0.25, 0.072169}, {0.1, 0.028868}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct accuracy accuracy = {.step = cases[i][0]};
        assert_close(accuracy_sigma(&accuracy, 100), cases[i][1], 5e-7);
    }
}

static void noise_floor_and_rounding_add_as_variances(void **state)
{
    (void)state;
    /* 0.5 * 0.68 / 10 = 0.034; floor 0.05, step 0.1: 0.001156 + 0.0025 + 0.01 / 12 */
    struct accuracy accuracy = {.cell = 0.5, .factor = 0.68, .floor = 0.05, .step = 0.1};
    assert_near(accuracy_sigma(&accuracy, 100), sqrt(0.001156 + 0.0025 + 0.01 / 12), 1e-15);
    assert_near(accuracy_sigma(&accuracy, HUGE_VAL), sqrt(0.0025 + 0.01 / 12), 1e-15);
    /* Weak: anywhere in the cell, then rounded. */
    assert_near(accuracy_sigma(&accuracy, 1), sqrt(0.25 / 12 + 0.01 / 12), 1e-15);
    assert_near(accuracy_sigma(&accuracy, 0), sqrt(0.25 / 12 + 0.01 / 12), 1e-15);
    accuracy.step = 0;
    assert_near(accuracy_sigma(&accuracy, 1e-300), 0.5 / sqrt(12), 1e-15);
    struct accuracy nothing = {0};
    assert_close(accuracy_sigma(&nothing, 0), 0, 0);
    assert_close(accuracy_sigma(&nothing, HUGE_VAL), 0, 0);
    /* Without a factor the floor is all, but for no echo at all. */
    struct accuracy exact = {.cell = 0.5, .floor = 0.05};
    assert_close(accuracy_sigma(&exact, 1e-9), 0.05, 1e-17);
    assert_near(accuracy_sigma(&exact, 0), 0.5 / sqrt(12), 1e-15);
}

static void effects_3_has_these_monopulse_sigmas(void **state)
{
    (void)state;
    static const double cases[][3] = {{0, 20, 2.5792},  {20, 20, 2.3581}, {40, 20, 1.7916},
                                      {0, 30, 0.8156},  {20, 30, 0.7457}, {40, 30, 0.5666},
                                      {-40, 30, 0.5666}};
    for (size_t i = 0; i < COUNT(cases); i++)
        assert_close(accuracy_dipole_pair_rad(cases[i][0] * DEGREE, snr_of(cases[i][1])) / DEGREE,
                     cases[i][2], 5e-5);
}

/* Noise across both pointers turns their angle u by (noise / amplitude) / sqrt 2 for each channel;
 * carried through the antenna's own inverse, by finite differences. */
static void monopulse_sigmas_are_the_antennas_slope(void **state)
{
    (void)state;
    static const struct antenna pair = {.pattern = ANTENNA_DIPOLE_PAIR, .phase = PHASE_CENTRE};
    uint64_t sample = 3;
    for (int i = 0; i < 10000; i++) {
        double azimuth_rad = sample_between(&sample, -1.4, 1.4);
        double snr = snr_of(sample_between(&sample, 15, 60));
        struct antenna_pointers at = antenna_pointers(&pair, azimuth_rad);
        double sum = creal(at.sum), delta = -cimag(at.delta), h = 1e-6 * sum;
        double by_sum = (antenna_azimuth_rad(&pair, delta, sum + h) -
                         antenna_azimuth_rad(&pair, delta, sum - h)) /
                        (2 * h);
        double by_delta = (antenna_azimuth_rad(&pair, delta + h, sum) -
                           antenna_azimuth_rad(&pair, delta - h, sum)) /
                          (2 * h);
        double component = sum / sqrt(2 * snr);
        double sigma_rad = component * sqrt(by_sum * by_sum + by_delta * by_delta);
        assert_near(accuracy_dipole_pair_rad(azimuth_rad, snr), sigma_rad, 2e-7);
    }
}

static void monopulse_sigmas_are_finite_everywhere(void **state)
{
    (void)state;
    assert_close(accuracy_dipole_pair_rad(0.3, 0), PI / sqrt(12), 0);
    assert_close(accuracy_dipole_pair_rad(0.3, 1e-300), PI / sqrt(12), 0);
    assert_close(accuracy_dipole_pair_rad(PI / 2, 100), 0, 1e-15);
    assert_close(accuracy_dipole_pair_rad(-PI / 2, 100), 0, 1e-15);
    assert_close(accuracy_dipole_pair_rad(0.3, HUGE_VAL), 0, 0);
    /* cos u / cos azimuth is (pi/4) cos azimuth before the side. */
    for (double aside = 1e-3; aside > 1e-9; aside /= 10)
        assert_near(accuracy_dipole_pair_rad(PI / 2 - aside, 50), aside / 20, 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(effects_3_has_these_sigmas),
        cmocka_unit_test(rounding_alone_has_the_sigma_of_effects_15),
        cmocka_unit_test(noise_floor_and_rounding_add_as_variances),
        cmocka_unit_test(effects_3_has_these_monopulse_sigmas),
        cmocka_unit_test(monopulse_sigmas_are_the_antennas_slope),
        cmocka_unit_test(monopulse_sigmas_are_finite_everywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
