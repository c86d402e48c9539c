#include "check.h"

#include "base/units.h"
#include "radar/antenna.h"
#include "radar/measurement_sigma.h"
#include "sample.h"

static const double CRAMER_RAO = 0.389848401;
static const double RULE_OF_THUMB = 0.70710678118654752;

static double snr_of(double db)
{
    return pow(10, db / 10);
}

TEST(sigmas_are_those_of_the_formula)
{
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
        struct measurement_sigma accuracy = {.cell = cases[i].cell, .factor = cases[i].factor};
        assert_close(measurement_sigma_at_snr(&accuracy, snr_of(cases[i].snr_db)), cases[i].sigma,
                     5e-7);
    }
}

TEST(noise_and_floor_add_as_variances_up_to_a_value_anywhere_in_the_cell)
{
    /* 0.5 * 0.68 / 10 = 0.034 and floor 0.05: 0.001156 + 0.0025 */
    struct measurement_sigma accuracy = {.cell = 0.5, .factor = 0.68, .sigma = 0.05};
    assert_near(measurement_sigma_at_snr(&accuracy, 100), sqrt(0.001156 + 0.0025), 1e-15);
    assert_near(measurement_sigma_at_snr(&accuracy, HUGE_VAL), 0.05, 1e-15);
    assert_near(measurement_sigma_at_snr(&accuracy, 1), 0.5 / sqrt(12), 1e-15);
    assert_near(measurement_sigma_at_snr(&accuracy, 0), 0.5 / sqrt(12), 1e-15);
    assert_near(measurement_sigma_at_snr(&accuracy, 1e-300), 0.5 / sqrt(12), 1e-15);
    struct measurement_sigma nothing = {0};
    assert_close(measurement_sigma_at_snr(&nothing, 0), 0, 0);
    assert_close(measurement_sigma_at_snr(&nothing, HUGE_VAL), 0, 0);
    /* Without a factor the floor is all, but for no echo at all. */
    struct measurement_sigma exact = {.cell = 0.5, .sigma = 0.05};
    assert_close(measurement_sigma_at_snr(&exact, 1e-9), 0.05, 1e-17);
    assert_near(measurement_sigma_at_snr(&exact, 0), 0.5 / sqrt(12), 1e-15);
}

/* MODEL 9: an amplitude twice the threshold halves sigma, one below it leaves it; noise of RMS 0.5
 * and an amplitude of 5 are 20 dB. */
TEST(each_law_has_its_own_sigma_at_an_amplitude)
{
    struct measurement_sigma quantity = {
        .sigma = 0.05, .cell = 0.5, .factor = 0.68, .threshold = 2, .noise = 0.5};
    assert_close(measurement_sigma_at(&quantity, 4), 0.05, 0);
    quantity.law = SIGMA_BY_AMPLITUDE;
    assert_close(measurement_sigma_at(&quantity, 4), 0.025, 1e-17);
    assert_close(measurement_sigma_at(&quantity, 1), 0.05, 0);
    quantity.law = SIGMA_BY_SNR;
    assert_near(measurement_sigma_at(&quantity, 5), sqrt(0.001156 + 0.0025), 1e-15);
}
