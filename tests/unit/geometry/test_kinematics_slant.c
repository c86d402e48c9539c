#include "check.h"

#include "base/units.h"
#include "geometry/kinematics.h"
#include "sample.h"

/* The example of MODEL 14.2: half a metre of difference in height. */
TEST(slant_ranges_are_those_of_the_model)
{
    static const struct {
        double distance_m, extra_m, cosine;
    } rows[] = {{3, 0.041381, 0.986394},
                {5, 0.024938, 0.995037},
                {10, 0.012492, 0.998752},
                {30, 0.004166, 0.999861}};
    for (size_t i = 0; i < COUNT(rows); i++)
        for (int sign = -1; sign <= 1; sign += 2) {
            struct slant elevation = kinematics_slant(rows[i].distance_m, 0.5 * sign);
            assert_close(elevation.range_m - rows[i].distance_m, rows[i].extra_m, 5.1e-7);
            assert_close(elevation.cosine, rows[i].cosine, 5.1e-7);
            assert_near(elevation.sine, 0.5 * sign / elevation.range_m, 1e-15);
        }
}

static double ulps(double actual, long double expected)
{
    double unit = nextafter(fabs((double)expected), 10) - fabs((double)expected);
    return fabs((double)(((long double)actual - expected) / (long double)unit));
}

/* A line array along y reads the angle between the sight line and the plane across it. */
TEST(azimuths_are_those_of_a_cone)
{
    uint64_t sample = 19;
    for (int i = 0; i < 100000; i++) {
        double distance_m = sample_between(&sample, 0.5, 100);
        double height_m = sample_between(&sample, -6, 6);
        double azimuth_rad = sample_between(&sample, -PI, PI);
        long double y_m = (long double)distance_m * sinl((long double)azimuth_rad);
        long double x_m = (long double)distance_m * cosl((long double)azimuth_rad);
        long double expected = atan2l(y_m, copysignl(hypotl(x_m, (long double)height_m), x_m));
        struct slant elevation = kinematics_slant(distance_m, height_m);
        double read_rad = kinematics_slant_azimuth_rad(elevation, azimuth_rad);
        if (!(ulps(read_rad, expected) <= 4))
            fail_msg("%.17g at %.17g, %.17g, %.17g: %g ulp", read_rad, distance_m, height_m,
                     azimuth_rad, ulps(read_rad, expected));
        assert_close(sin(read_rad), sin(azimuth_rad) * elevation.cosine, 1e-15);
    }
}

TEST(abeam_the_azimuth_is_90_degrees_less_the_elevation)
{
    struct slant elevation = kinematics_slant(3, 4);
    double up_rad = atan2(4, 3);
    assert_close(kinematics_slant_azimuth_rad(elevation, PI / 2), PI / 2 - up_rad, 1e-15);
    assert_close(kinematics_slant_azimuth_rad(elevation, -PI / 2), up_rad - PI / 2, 1e-15);
    assert_close(kinematics_slant_azimuth_rad(elevation, 0), 0, 0);
}

TEST(at_equal_heights_nothing_changes)
{
    uint64_t sample = 20;
    for (int i = 0; i < 10000; i++) {
        double distance_m = sample_between(&sample, 1e-3, 300);
        double azimuth_rad = sample_between(&sample, -PI, PI);
        struct slant level = kinematics_slant(distance_m, 0);
        assert_memory_equal(&level.range_m, &distance_m, sizeof distance_m);
        assert_close(level.cosine, 1, 0);
        double read_rad = kinematics_slant_azimuth_rad(level, azimuth_rad);
        assert_memory_equal(&read_rad, &azimuth_rad, sizeof azimuth_rad);
        assert_close(kinematics_slant_amplitude_factor(level, 5 * DEGREE), 1, 0);
    }
}

TEST(half_the_power_is_left_at_half_the_width)
{
    for (int deg = 1; deg <= 20; deg++)
        for (int sign = -1; sign <= 1; sign += 2) {
            struct slant edge =
                kinematics_slant(10 * cos(deg * DEGREE), sign * 10 * sin(deg * DEGREE));
            assert_near(kinematics_slant_amplitude_factor(edge, deg * DEGREE), 0.5, 1e-14);
            assert_near(kinematics_slant_amplitude_factor(edge, 2 * deg * DEGREE), pow(0.5, 0.25),
                        1e-14);
        }
}

TEST(the_zenith_and_the_sensors_own_place_have_answers)
{
    struct slant zenith = kinematics_slant(0, 2);
    assert_close(zenith.range_m, 2, 0);
    assert_close(zenith.cosine, 0, 0);
    assert_close(kinematics_slant_azimuth_rad(zenith, 1), 0, 0);
    assert_true(kinematics_slant_amplitude_factor(zenith, 1 * DEGREE) >= 0);
    struct slant here = kinematics_slant(0, 0);
    assert_close(here.range_m, 0, 0);
    assert_close(here.cosine, 1, 0);
    assert_close(kinematics_slant_amplitude_factor(here, 5 * DEGREE), 1, 0);
}
