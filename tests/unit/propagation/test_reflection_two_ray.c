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

/* A wave that is late by a share of its length. */
static double _Complex late(double waves)
{
    return cos(2 * PI * waves) - sin(2 * PI * waves) * (double _Complex)I;
}

/* The power that MODEL 14.10 divides by. */
static double mean_over_phase(double bounced)
{
    return 1 + 4 * pow(bounced, 2) + pow(bounced, 4);
}

static double factor_db(double reflection, double carrier_hz, double distance_m)
{
    struct two_ray_ends ends = ends_at(distance_m);
    struct two_ray_paths paths = reflection_two_ray_paths(&ends);
    return units_amplitude_db(
        reflection_two_ray_factor(&paths, reflection, units_wavelength_m(carrier_hz)));
}

/* The factor of a reflector on asphalt, by an upright field of 4 mm. */
static double on_asphalt(const struct two_ray_ends *ends)
{
    struct two_ray_paths paths = reflection_two_ray_paths(ends);
    double _Complex reflection =
        reflection_road(&ASPHALT, POLARIZATION_VERTICAL, 0.004, paths.grazing_sine);
    return reflection_two_ray_factor(&paths, reflection, 0.004);
}

/* Both ends on the road at one place: the waves add as they are. */
TEST(without_a_way_the_bounced_wave_loses_nothing_by_spreading)
{
    struct two_ray_ends ends = {0, 0, 0, 0};
    struct two_ray_paths paths = reflection_two_ray_paths(&ends);
    assert_close(reflection_two_ray_factor(&paths, -0.5, 0.004), 0.25 / sqrt(2.0625), 1e-15);
    assert_close(reflection_two_ray_factor(&paths, 0.5, 0.004), 2.25 / sqrt(2.0625), 1e-15);
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
            assert_true(factor_db(-1, rows[i].carrier_hz, rows[i].null_m[n - 1]) < -38);
        }
        assert_close(factor_db(-1, rows[i].carrier_hz, 2 * rows[i].null_m[0]), 10 * log10(16.0 / 6),
                     0.01);
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
        struct two_ray_paths paths = {.direct_m = 10,
                                      .bounced_m = sample_between(&sample, 10, 12),
                                      .difference_m = sample_between(&sample, 0, 0.1)};
        double _Complex reflection = sample_between(&sample, -0.7, 0.7) +
                                     sample_between(&sample, -0.7, 0.7) * (double _Complex)I;
        double _Complex bounced = reflection * (paths.direct_m / paths.bounced_m);
        double _Complex sum = 1 + bounced * late(paths.difference_m / 0.004);
        assert_close(pow(reflection_two_ray_factor(&paths, reflection, 0.004), 2),
                     pow(size(sum), 4) / mean_over_phase(size(bounced)), 1e-12);
    }
}

TEST(a_road_changes_no_mean_over_phase)
{
    for (double reflection = 0; reflection <= 1; reflection += 0.1) {
        double power = 0;
        for (int k = 0; k < 16; k++) {
            struct two_ray_paths paths = {1, 1, .difference_m = k / 16.0};
            power += pow(reflection_two_ray_factor(&paths, -reflection, 1), 2) / 16;
        }
        assert_close(power, 1, 1e-14);
    }
}

/* MODEL 14.10: a lobe is 0.12 m high at 4 mm, 30 m and 0.5 m. The mean over an extent is that of
 * points along it, over the mean over all phases. */
TEST(a_reflector_has_the_mean_of_its_points)
{
    enum { POINTS = 10000 };
    static const double extents_m[] = {0.001, 0.01, 0.03, 0.06, 0.12, 0.3, 0.7};
    for (size_t i = 0; i < sizeof extents_m / sizeof *extents_m; i++) {
        struct two_ray_ends ends = ends_at(30);
        double power = 0;
        for (int k = 0; k < POINTS; k++) {
            ends.reflector_height_m = 0.6 + ((k + 0.5) / POINTS - 0.5) * extents_m[i];
            power += pow(on_asphalt(&ends), 2) / POINTS;
        }
        ends = ends_at(30);
        ends.extent_m = extents_m[i];
        assert_close(pow(on_asphalt(&ends), 2), power, 4e-3);
    }
}

TEST(the_factor_goes_from_that_of_a_point_to_one_without_a_step)
{
    for (double distance_m = 20; distance_m < 30; distance_m += 0.37) {
        struct two_ray_ends ends = ends_at(distance_m);
        double before = pow(on_asphalt(&ends), 2), lobe_m = 0.004 * distance_m / (2 * 0.5);
        for (ends.extent_m = 1e-4; ends.extent_m < 3; ends.extent_m += 1e-4) {
            double factor = pow(on_asphalt(&ends), 2);
            assert_close(factor, before, 4e-3);
            assert_close(factor, 1, 0.5 * lobe_m / ends.extent_m);
            before = factor;
        }
    }
}

TEST(a_road_that_reflects_nothing_changes_nothing)
{
    struct two_ray_paths paths = {10, 10.1, 0.3, 0.1, 0.1};
    assert_close(reflection_two_ray_factor(&paths, 0, 0.004), 1, 0);
}

/* The largest factor at all bounds what may be left out (MODEL 14.23). */
TEST(no_echo_rises_by_more_than_by_a_perfect_mirror)
{
    double most = 0;
    for (double reflection = 0; reflection <= 1; reflection += 1.0 / 64)
        for (int k = 0; k < 64; k++)
            for (double spread_m = 0; spread_m < 2; spread_m += 0.25) {
                struct two_ray_paths paths = {1, 1, k / 64.0, spread_m, 0};
                most = fmax(most, reflection_two_ray_factor(&paths, -reflection, 1));
            }
    assert_near(most, 4 / sqrt(6.0), 1e-15);
}

/* At Brewster's angle, 24 degrees, asphalt hardly mirrors an upright field; higher up, its
 * roughness takes the rest. */
TEST(a_reflector_high_above_the_road_keeps_its_amplitude)
{
    for (double height_m = 4; height_m < 40; height_m *= 1.01) {
        struct two_ray_ends ends = {0.5, height_m, 0, 10};
        assert_close(on_asphalt(&ends), 1, 0.1);
    }
}

TEST(ends_on_the_road_give_numbers)
{
    for (int i = 0; i < 16; i++) {
        struct two_ray_ends ends = {i & 1 ? 0.5 : 0, i & 2 ? 0.5 : 0, i & 4 ? 1 : 0,
                                    i & 8 ? 20 : 0};
        double factor = on_asphalt(&ends);
        assert_true(factor >= 0 && factor <= 4 / sqrt(6.0));
    }
}
