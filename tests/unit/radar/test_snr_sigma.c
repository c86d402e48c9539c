#include "check.h"

#include "base/units.h"
#include "radar/antenna.h"
#include "radar/snr_sigma.h"
#include "sample.h"

#define DEGREE (PI / 180)
#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static const double CRAMER_RAO = 0.389848401;
static const double RULE_OF_THUMB = 0.70710678118654752;

static double snr_of(double db)
{
    return pow(10, db / 10);
}

static void sigmas_are_those_of_the_formula(void **state)
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
        struct snr_sigma accuracy = {.cell = cases[i].cell, .factor = cases[i].factor};
        assert_close(snr_sigma_of(&accuracy, snr_of(cases[i].snr_db)), cases[i].sigma, 5e-7);
    }
}

/* MODEL 9: steps of 0.2 m, 0.25 m/s and 0.1 deg alone. */
static void rounding_alone_has_the_sigma_of_its_step(void **state)
{
    (void)state;
    static const double cases[][2] = {{0.2, 0.057735}, {0.25, 0.072169}, {0.1, 0.028868}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct snr_sigma accuracy = {.step = cases[i][0]};
        assert_close(snr_sigma_of(&accuracy, 100), cases[i][1], 5e-7);
    }
}

static void noise_floor_and_rounding_add_as_variances(void **state)
{
    (void)state;
    /* 0.5 * 0.68 / 10 = 0.034; floor 0.05, step 0.1: 0.001156 + 0.0025 + 0.01 / 12 */
    struct snr_sigma accuracy = {.cell = 0.5, .factor = 0.68, .floor = 0.05, .step = 0.1};
    assert_near(snr_sigma_of(&accuracy, 100), sqrt(0.001156 + 0.0025 + 0.01 / 12), 1e-15);
    assert_near(snr_sigma_of(&accuracy, HUGE_VAL), sqrt(0.0025 + 0.01 / 12), 1e-15);
    /* Weak: anywhere in the cell, then rounded. */
    assert_near(snr_sigma_of(&accuracy, 1), sqrt(0.25 / 12 + 0.01 / 12), 1e-15);
    assert_near(snr_sigma_of(&accuracy, 0), sqrt(0.25 / 12 + 0.01 / 12), 1e-15);
    accuracy.step = 0;
    assert_near(snr_sigma_of(&accuracy, 1e-300), 0.5 / sqrt(12), 1e-15);
    struct snr_sigma nothing = {0};
    assert_close(snr_sigma_of(&nothing, 0), 0, 0);
    assert_close(snr_sigma_of(&nothing, HUGE_VAL), 0, 0);
    /* Without a factor the floor is all, but for no echo at all. */
    struct snr_sigma exact = {.cell = 0.5, .floor = 0.05};
    assert_close(snr_sigma_of(&exact, 1e-9), 0.05, 1e-17);
    assert_near(snr_sigma_of(&exact, 0), 0.5 / sqrt(12), 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sigmas_are_those_of_the_formula),
        cmocka_unit_test(rounding_alone_has_the_sigma_of_its_step),
        cmocka_unit_test(noise_floor_and_rounding_add_as_variances),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
