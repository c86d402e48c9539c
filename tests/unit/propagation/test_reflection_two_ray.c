#include "check.h"

#include "base/units.h"
#include "propagation/reflection.h"
#include "sample.h"

static const struct two_ray_road ASPHALT = {{5, 0.25}, 1e-3};

static struct two_ray_ends ends_at(double distance_m)
{
    return (struct two_ray_ends){0.5, 0.6, 0, distance_m};
}

static double size(double _Complex reflection)
{
    return hypot(creal(reflection), cimag(reflection));
}

static double point_db(double reflection, double carrier_hz, double distance_m)
{
    struct two_ray_ends ends = ends_at(distance_m);
    struct two_ray_paths paths = reflection_two_ray_paths(&ends);
    return units_amplitude_db(
        reflection_two_ray_point_factor(&paths, reflection, units_wavelength_m(carrier_hz)));
}

/* Both ends on the road at one place: the waves add as they are. */
TEST(without_a_way_the_bounced_wave_loses_nothing_by_spreading)
{
    struct two_ray_ends ends = {0, 0, 0, 0};
    struct two_ray_paths paths = reflection_two_ray_paths(&ends);
    assert_close(reflection_two_ray_point_factor(&paths, -0.5, 0.004), 0.25, 1e-15);
    assert_close(reflection_two_ray_point_factor(&paths, 0.5, 0.004), 2.25, 1e-15);
}

TEST(path_difference_keeps_its_digits_far_away)
{
    for (double distance_m = 1; distance_m < 1e7; distance_m *= 1.7) {
        struct two_ray_ends ends = ends_at(distance_m);
        long double direct = hypotl((long double)distance_m, 0.5L - (long double)0.6);
        long double bounced = hypotl((long double)distance_m, 0.5L + (long double)0.6);
        long double expected = 4 * 0.5L * (long double)0.6 / (direct + bounced);
        struct two_ray_paths paths = reflection_two_ray_paths(&ends);
        assert_near(paths.difference_m, (double)expected, 1e-15);
        assert_near(paths.direct_m, (double)direct, 4e-16);
        assert_near(paths.bounced_m, (double)bounced, 4e-16);
    }
}

/* MODEL 14.10: nulls at 2 h_s h_r/(n lambda), to first order; the last maximum at twice the first.
 */
TEST(echoes_fade_where_the_paths_differ_by_whole_waves)
{
    static const struct {
        double carrier_hz, null_m[3];
    } rows[] = {{76.5e9, {153.1059, 76.5530, 51.0353}}, {24.125e9, {48.2834, 24.1417, 16.0945}}};
    for (size_t i = 0; i < 2; i++) {
        double wavelength_m = units_wavelength_m(rows[i].carrier_hz);
        for (int n = 1; n <= 3; n++) {
            struct two_ray_ends ends = ends_at(rows[i].null_m[n - 1]);
            assert_near(reflection_two_ray_paths(&ends).difference_m / wavelength_m, (double)n,
                        2e-3);
            assert_true(point_db(-1, rows[i].carrier_hz, rows[i].null_m[n - 1]) < -30);
        }
        assert_close(point_db(-1, rows[i].carrier_hz, 2 * rows[i].null_m[0]), 20 * log10(4), 0.01);
    }
}

TEST(reflection_agrees_with_complex_arithmetic)
{
    uint64_t sample = 6;
    for (int i = 0; i < 10000; i++) {
        struct two_ray_road road = {
            {sample_between(&sample, 1.01, 40), sample_between(&sample, 0, 40)},
            sample_between(&sample, 0, 2e-3)};
        double sine = sample_between(&sample, 0, 1), wavelength_m = 0.004;
        double _Complex permittivity =
            road.permittivity.real - road.permittivity.loss * (double _Complex)I;
        double _Complex r = csqrt(permittivity - (1 - sine * sine));
        double rough = exp(-8 * pow(PI * road.roughness_m * sine / wavelength_m, 2));
        double _Complex horizontal = rough * (sine - r) / (sine + r);
        double _Complex vertical = rough * (permittivity * sine - r) / (permittivity * sine + r);
        assert_close(
            size(reflection_road(&road, POLARIZATION_HORIZONTAL, wavelength_m, sine) - horizontal),
            0, 1e-14);
        assert_close(
            size(reflection_road(&road, POLARIZATION_VERTICAL, wavelength_m, sine) - vertical), 0,
            1e-14);
    }
}

TEST(a_bounced_wave_is_late_by_the_path_difference)
{
    uint64_t sample = 5;
    for (int i = 0; i < 10000; i++) {
        struct two_ray_paths paths = {10, sample_between(&sample, 10, 12),
                                      sample_between(&sample, 0, 0.1), 0};
        double _Complex reflection = sample_between(&sample, -0.7, 0.7) +
                                     sample_between(&sample, -0.7, 0.7) * (double _Complex)I;
        double phase = -2 * PI * paths.difference_m / 0.004;
        double _Complex late = cos(phase) + sin(phase) * (double _Complex)I;
        double _Complex sum = 1 + reflection * (paths.direct_m / paths.bounced_m) * late;
        assert_close(reflection_two_ray_point_factor(&paths, reflection, 0.004), pow(size(sum), 2),
                     1e-12);
    }
}

TEST(the_mean_is_that_of_power_over_all_phases)
{
    for (double reflection = 0; reflection <= 1; reflection += 0.1) {
        double power = 0;
        for (int k = 0; k < 16; k++) {
            struct two_ray_paths paths = {1, 1, k / 16.0, 0};
            power += pow(reflection_two_ray_point_factor(&paths, -reflection, 1), 2) / 16;
        }
        assert_near(reflection_two_ray_mean_factor(reflection), sqrt(power), 1e-14);
    }
}

/* MODEL 14.10: a lobe is 0.1176 m high at 76.5 GHz, 30 m and 0.5 m. */
TEST(reflectors_higher_than_half_a_lobe_get_the_mean)
{
    double wavelength_m = units_wavelength_m(76.5e9);
    struct two_ray_ends ends = ends_at(30);
    struct two_ray_paths paths = reflection_two_ray_paths(&ends);
    double _Complex reflection =
        reflection_road(&ASPHALT, POLARIZATION_VERTICAL, wavelength_m, paths.grazing_sine);
    double point = reflection_two_ray_point_factor(&paths, reflection, wavelength_m);
    double mean =
        reflection_two_ray_mean_factor(size(reflection) * paths.direct_m / paths.bounced_m);
    assert_true(fabs(point - mean) > 0.01);
    static const double extents_m[] = {0, 0.1175 / 2, 0.1177 / 2, 2};
    for (size_t i = 0; i < 4; i++) {
        ends.extent_m = extents_m[i];
        assert_near(reflection_two_ray_factor(&ASPHALT, POLARIZATION_VERTICAL, wavelength_m, &ends),
                    i < 2 ? point : mean, 1e-15);
    }
}

TEST(a_road_that_reflects_nothing_changes_nothing)
{
    struct two_ray_paths paths = {10, 10.1, 0.3, 0.1};
    assert_close(reflection_two_ray_point_factor(&paths, 0, 0.004), 1, 0);
    assert_close(reflection_two_ray_mean_factor(0), 1, 0);
}

TEST(ends_on_the_road_give_numbers)
{
    for (int i = 0; i < 16; i++) {
        struct two_ray_ends ends = {i & 1 ? 0.5 : 0, i & 2 ? 0.5 : 0, i & 4 ? 1 : 0,
                                    i & 8 ? 20 : 0};
        double factor = reflection_two_ray_factor(&ASPHALT, POLARIZATION_VERTICAL, 0.004, &ends);
        assert_true(factor >= 0 && factor <= 4);
    }
}
