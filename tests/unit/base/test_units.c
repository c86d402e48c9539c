#include "check.h"

#include "base/units.h"

TEST(amplitude_decibels_are_twenty_to_the_decade)
{
    assert_close(units_amplitude_db(1), 0, 0);
    assert_near(units_amplitude_db(10), 20.0, 1e-15);
    assert_near(units_amplitude_db(0.001), -60.0, 1e-15);
    assert_near(units_amplitude_db(2), 6.0205999132796239, 1e-15);
}

TEST(six_decibels_are_the_paper_threshold)
{
    assert_near(units_amplitude_from_db(6), 1.9952623149688797, 1e-15);
    assert_near(units_amplitude_from_db(-6), 1 / 1.9952623149688797, 1e-15);
    assert_close(units_amplitude_from_db(0), 1, 0);
}

/* Published wavelengths of the radar bands. */
TEST(wavelengths_are_those_of_the_radar_bands)
{
    assert_near(units_wavelength_m(24.125e9), 0.0124266303, 1e-8);
    assert_near(units_wavelength_m(76.5e9), 0.00391885566, 2e-9);
    assert_near(units_wavelength_m(79e9), 0.00379484124, 2e-9);
}

TEST(a_shortfall_is_a_bounded_count_of_decibels)
{
    assert_close(units_shortfall_db(2, 2), 0, 0);
    assert_close(units_shortfall_db(2, 3), 0, 0);
    assert_near(units_shortfall_db(2, 1), 6.0205999132796239, 1e-15);
    assert_near(units_shortfall_db(0.5, 0.005), 40.0, 1e-15);
    assert_close(units_shortfall_db(2, 0), 1e4, 0);
}

TEST(amplitudes_come_back_from_decibels)
{
    for (int i = -600; i <= 600; i++) {
        double db = 0.37 * i;
        assert_close(units_amplitude_db(units_amplitude_from_db(db)), db, 1e-13);
    }
}

TEST(an_angle_wraps_into_one_turn)
{
    static const struct {
        double angle, wrapped, tolerance;
    } cases[] = {
        {0, 0, 0},
        {1, 1, 0},
        {-3, -3, 0},
        {PI, PI, 0},
        {-PI, PI, 0},
        {3 * PI, 0x1.921fb54442d17p1, 0},
        {-3 * PI, -0x1.921fb54442d17p1, 0},   /* this double is less than three half turns */
        {2 * PI, -2.4492935982947064e-16, 0}, /* and this one less than a whole turn */
        {-2 * PI, 2.4492935982947064e-16, 0},
        {-1e-17, -1e-17, 0},
        {2 * PI - 0.5, -0.5, 1e-15},
        {5, 5 - 2 * PI, 1e-15},
        {-5, 2 * PI - 5, 1e-15},
        {100, 100 - 32 * PI, 1e-14},
    };
    for (size_t i = 0; i < COUNT(cases); i++)
        assert_close(units_wrap_rad(cases[i].angle), cases[i].wrapped, cases[i].tolerance);
}

TEST(si_is_sine_over_argument_to_two_ulp)
{
    assert_close(units_si(0), 1, 0);
    assert_near(units_si(PI / 2), 2 / PI, 3e-16);
    for (int i = 0; i <= 200000; i++) {
        double x = i < 100000 ? 3.0 * (i + 1) / 100000 : 3 * pow(10, -0.003 * (i - 100000));
        long double exact = sinl((long double)x) / (long double)x;
        double ulp = ldexp(1, ilogb((double)exact) - 52);
        assert_close((double)((long double)units_si(x) - exact), 0, 2 * ulp);
        assert_close(units_si(-x), units_si(x), 0);
    }
}

TEST(steps_round_to_the_nearest_multiple)
{
    static const double cases[][3] = {{12.3456, 0, 12.3456}, {12.34, 0.25, 12.25},
                                      {12.4, 0.25, 12.5},    {-12.4, 0.25, -12.5},
                                      {0.125, 0.25, 0.25},   {-0.125, 0.25, -0.25},
                                      {0.1, 0.25, 0},        {7, 2, 8},
                                      {1e6, 1000, 1e6},      {3, 1, 3},
                                      {1e6, 5e-324, 1e6},    {-0.3, 1e-320, -0.3},
                                      {0, 5e-324, 0},        {5e-324, 1e3, 0}};
    for (size_t i = 0; i < COUNT(cases); i++)
        assert_close(units_rounded(cases[i][0], cases[i][1]), cases[i][2], 0);
}
