#include "check.h"

#include "base/units.h"
#include "radar/interferer.h"

/* MODEL 14.17. */
TEST(received_power_is_as_published)
{
    static const struct {
        double eirp_dbm, gain_db, carrier_hz, range_m, power_dbm;
    } rows[] = {{33, 20, 76.5e9, 10, -37.1210},   {33, 20, 76.5e9, 50, -51.1004},
                {33, 20, 76.5e9, 100, -57.1210},  {20, 13, 24.125e9, 10, -47.0971},
                {20, 13, 24.125e9, 50, -61.0765}, {20, 13, 24.125e9, 100, -67.0971}};
    for (size_t i = 0; i < COUNT(rows); i++)
        assert_close(interferer_power_dbm(rows[i].eirp_dbm, rows[i].gain_db,
                                          units_wavelength_m(rows[i].carrier_hz), rows[i].range_m),
                     rows[i].power_dbm, 5.1e-5);
}

/* MODEL 14.17. */
TEST(noise_is_as_published)
{
    assert_close(interferer_noise_dbm(1, 0), -173.975187, 5.1e-7);
    assert_close(interferer_noise_dbm(10e6, 12), -91.9752, 6e-5);
}

/* MODEL 14.17: with amplitudes that fall as 1/R^2, 10 dB cost 44 % of the range. */
TEST(ranges_shrink_as_published)
{
    assert_near(interferer_noise_factor(9), sqrt(10), 1e-15);
    assert_close(1 / sqrt(interferer_noise_factor(9)), 0.562341, 5.1e-7);
    assert_close(units_amplitude_db(interferer_noise_factor(pow(10, -0.6))), 0.973, 5.1e-4);
}

TEST(equal_slopes_stay_in_band)
{
    assert_near(interferer_overlap(20e6, 15e12, 20e-6), 4. / 3 / 20, 1e-12);
    assert_close(interferer_overlap(20e6, 0, 20e-6), 1, 0);
    assert_close(interferer_overlap(20e6, 1e3, 20e-6), 1, 0);
    assert_close(interferer_overlap(20e6, -15e12, 20e-6), interferer_overlap(20e6, 15e12, 20e-6),
                 0);
}

TEST(the_ratio_counts_the_power_in_band_and_the_chirps_that_are_hit)
{
    assert_near(interferer_ratio(-51, -91, 0.5, 0.1), 1e4 * 0.5 * 0.1, 1e-12);
}

TEST(silence_leaves_the_noise_alone)
{
    assert_close(interferer_noise_factor(0), 1, 0);
    assert_close(interferer_ratio(-1e4, -90, 1, 1), 0, 0);
}
