#include "check.h"

#include "base/units.h"
#include "radar/antenna.h"
#include "radar/measurement_sigma.h"
#include "sample.h"

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
