#include "check.h"

#include "base/units.h"
#include "propagation/attenuation.h"

static double db(double factor)
{
    return -units_amplitude_db(factor);
}

/* The table of ITU-R P.838-3 itself, to its digits. */
TEST(the_law_is_the_table_of_the_recommendation)
{
    static const struct {
        double ghz, digit;
        struct attenuation_law horizontal, vertical;
    } rows[] = {
        {6, 1e-7, {0.0007056, 1.5900}, {0.0004878, 1.5728}},
        {7, 1e-6, {0.001915, 1.4810}, {0.001425, 1.4745}},
        {10, 1e-5, {0.01217, 1.2571}, {0.01129, 1.2156}},
        {20, 1e-5, {0.09164, 1.0568}, {0.09611, 0.9847}},
        {25, 1e-4, {0.1571, 0.9991}, {0.1533, 0.9491}},
        {60, 1e-4, {0.8606, 0.7656}, {0.8515, 0.7486}},
        {70, 1e-4, {1.0315, 0.7345}, {1.0253, 0.7215}},
        {80, 1e-4, {1.1704, 0.7115}, {1.1668, 0.7021}},
        {100, 1e-4, {1.3671, 0.6815}, {1.3680, 0.6765}},
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        struct attenuation_law horizontal =
            attenuation_rain_law(rows[i].ghz * 1e9, POLARIZATION_HORIZONTAL);
        struct attenuation_law vertical =
            attenuation_rain_law(rows[i].ghz * 1e9, POLARIZATION_VERTICAL);
        assert_close(horizontal.k, rows[i].horizontal.k, 0.501 * rows[i].digit);
        assert_close(horizontal.alpha, rows[i].horizontal.alpha, 0.501e-4);
        assert_close(vertical.k, rows[i].vertical.k, 0.501 * rows[i].digit);
        assert_close(vertical.alpha, rows[i].vertical.alpha, 0.501e-4);
    }
}

/* MODEL 14.15: at 10 deg C, and 0.5 g/m^3 over 100 m. */
TEST(fog_is_as_published)
{
    assert_close(attenuation_fog_dbpkm(24.125e9, 10, 1), 0.389249, 5.1e-7);
    assert_close(attenuation_fog_dbpkm(76.5e9, 10, 1), 3.115457, 5.1e-7);
    double dense = attenuation_fog_dbpkm(76.5e9, 10, 0.5);
    assert_close(db(attenuation_amplitude_factor(dense, 100)), 0.311546, 5.1e-7);
}

TEST(rain_attenuates_by_a_power_of_its_rate)
{
    const struct attenuation_law law = {.k = 1.1, .alpha = 0.7};
    for (double rate_mmph = 0.1; rate_mmph < 200; rate_mmph *= 2)
        assert_near(attenuation_rain_dbpkm(law, rate_mmph), 1.1 * pow(rate_mmph, 0.7), 1e-14);
}

TEST(dry_air_and_no_range_take_nothing)
{
    struct attenuation_law law = attenuation_rain_law(76.5e9, POLARIZATION_HORIZONTAL);
    assert_close(attenuation_rain_dbpkm(law, 0), 0, 0);
    assert_close(attenuation_fog_dbpkm(76.5e9, 10, 0), 0, 0);
    assert_close(attenuation_amplitude_factor(0, 250), 1, 0);
    assert_close(attenuation_amplitude_factor(10, 0), 1, 0);
    assert_close(attenuation_amplitude_factor(1e9, 1e6), 0, 0);
}

TEST(two_stretches_attenuate_like_one)
{
    for (int range_m = 1; range_m < 300; range_m++)
        assert_near(attenuation_amplitude_factor(8, range_m) * attenuation_amplitude_factor(8, 50),
                    attenuation_amplitude_factor(8, range_m + 50), 1e-15);
}
