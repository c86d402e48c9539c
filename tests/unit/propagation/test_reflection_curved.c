#include "check.h"

#include "base/units.h"
#include "propagation/reflection.h"
#include "radar/radar_equation.h"
#include "sample.h"

static double dbsm(double cross_section_m2)
{
    return 10 * log10(cross_section_m2);
}

TEST(cross_sections_are_those_of_geometrical_optics)
{
    assert_close(reflection_curved_cross_section_m2(0.5, 0.5, 5), 0.649089391, 5e-10);
    static const struct {
        double radius_1_m, radius_2_m, range_m, dbsm, tolerance;
    } cases[] = {
        {HUGE_VAL, HUGE_VAL, 10, 24.971499, 5e-7},
        {HUGE_VAL, HUGE_VAL, 30, 34.513924, 5e-7},
        {HUGE_VAL, HUGE_VAL, 50, 38.950899, 5e-7},
        {1e9, 1e9, 10, 24.971499, 6e-7},
        {20, 1.5, 5, 11.6136, 5e-5},
        {20, 1.5, 10, 14.3645, 5e-5},
        {20, 1.5, 20, 16.4183, 5e-5},
        {20, 1.5, 50, 18.1531, 5e-5},
        {20, 1.5, 1e9, 19.7427, 5e-5},
        {1.5, 20, 50, 18.1531, 5e-5},
    };
    for (size_t i = 0; i < COUNT(cases); i++)
        assert_close(dbsm(reflection_curved_cross_section_m2(
                         cases[i].radius_1_m, cases[i].radius_2_m, cases[i].range_m)),
                     cases[i].dbsm, cases[i].tolerance);
}

/* MODEL 14.5: a straight rail with corrugations of 4 cm, nearly pi r2 R. */
TEST(a_rail_is_lit_along_a_line)
{
    for (double range_m = 0.5; range_m < 200; range_m *= 1.5) {
        double rail_m2 = PI * 0.04 * range_m * range_m / (0.04 + range_m);
        assert_near(reflection_curved_cross_section_m2(HUGE_VAL, 0.04, range_m), rail_m2, 1e-15);
        assert_near(reflection_curved_cross_section_m2(1e9, 0.04, range_m), rail_m2, 3e-7);
    }
}

/* The formula as it stands, in extended precision, over thirty decades. */
TEST(no_radius_and_no_range_is_too_large_or_too_small)
{
    uint64_t sample = 22;
    for (int i = 0; i < 100000; i++) {
        double r1 = pow(10, sample_between(&sample, -9, 12));
        double r2 = pow(10, sample_between(&sample, -9, 12));
        double range_m = pow(10, sample_between(&sample, -12, 6));
        long double a = (long double)r1, b = (long double)r2, r = (long double)range_m;
        long double exact = 3.14159265358979323846L * a * b * r * r / ((a + r) * (b + r));
        assert_near(reflection_curved_cross_section_m2(r1, r2, range_m), (double)exact, 1e-15);
        assert_near(radar_ercs(reflection_curved_cross_section_m2(r1, r2, range_m)),
                    (double)sqrtl(exact / 10), 1e-15);
    }
}

TEST(nothing_is_zero_and_never_nan)
{
    static const double radii_m[] = {0, 1e-300, 1, 1e9, HUGE_VAL};
    for (size_t i = 0; i < COUNT(radii_m); i++) {
        assert_close(reflection_curved_cross_section_m2(radii_m[i], 0, 0), 0, 0);
        assert_close(reflection_curved_cross_section_m2(0, radii_m[i], 7), 0, 0);
        assert_close(radar_ercs(reflection_curved_cross_section_m2(radii_m[i], radii_m[i], 0)), 0,
                     0);
    }
}

/* Back to where it came from, a wave that a curved surface mirrors is its echo, against a plane's.
 */
TEST(a_wave_mirrored_straight_back_is_the_echo)
{
    uint64_t sample = 9;
    for (int i = 0; i < 1000; i++) {
        double r1 = pow(10, sample_between(&sample, -2, 4));
        double r2 = pow(10, sample_between(&sample, -2, 4));
        double range_m = sample_between(&sample, 0.1, 200);
        double divergence = reflection_divergence(r1, r2, 1, range_m / 2);
        assert_near(PI * range_m * range_m * divergence * divergence,
                    reflection_curved_cross_section_m2(r1, r2, range_m), 2e-15);
    }
}

/* A radius counts times the cosine in the plane of incidence, over it across. */
TEST(curvature_in_the_plane_of_incidence_spreads_grazing_waves_most)
{
    assert_near(reflection_divergence(20, HUGE_VAL, 0.25, 10), 1 / sqrt(1 + 4), 1e-15);
    assert_near(reflection_divergence(HUGE_VAL, 20, 0.25, 10), 1 / sqrt(1 + 0.25), 1e-15);
    assert_near(reflection_divergence(20, 20, 0.25, 10), 1 / sqrt(5 * 1.25), 1e-15);
    assert_close(reflection_divergence(HUGE_VAL, HUGE_VAL, 1e-9, 1e6), 1, 0);
    assert_close(reflection_divergence(1e-3, 1e-3, 1, 0), 1, 0);
}
