#include "check.h"

#include "base/units.h"
#include "geometry/obstruction.h"
#include "knife_edge.h"

TEST(losses_are_fresnels_at_the_edge_and_behind)
{
    for (double parameter = -0.77; parameter < 12; parameter += 0.01)
        assert_close(knife_edge_db(parameter), knife_edge_exact_db(parameter), 0.15);
}

TEST(deeper_is_darker)
{
    double before = 1;
    for (double parameter = -2; parameter < 100; parameter += 0.01) {
        double factor = obstruction_edge_amplitude_factor(parameter);
        assert_true(factor <= before && factor > 0);
        before = factor;
    }
}

TEST(outside_the_shadow_all_is_seen)
{
    assert_close(obstruction_edge_amplitude_factor(-0.78), 1, 0);
    assert_close(obstruction_edge_amplitude_factor(-1e300), 1, 0);
    assert_close(obstruction_edge_amplitude_factor((double)-INFINITY), 1, 0);
    double wavelength_m = 0.0039;
    double radius_m = sqrt(wavelength_m * 4 * 9 / 13);
    assert_close(obstruction_edge_parameter(-radius_m, 4, 9, wavelength_m), -sqrt(2), 1e-15);
    assert_close(obstruction_edge_amplitude_factor(
                     obstruction_edge_parameter(-0.5516 * radius_m, 4, 9, wavelength_m)),
                 1, 0);
    assert_true(obstruction_edge_amplitude_factor(
                    obstruction_edge_parameter(-0.55 * radius_m, 4, 9, wavelength_m)) < 1);
    assert_true(obstruction_edge_amplitude_factor(nextafter(-0.78, 0)) > 0.999);
}

TEST(far_inside_nothing_is_left)
{
    assert_close(obstruction_edge_amplitude_factor(1e300), 0, 0);
    assert_close(obstruction_edge_amplitude_factor((double)INFINITY), 0, 0);
}

TEST(ends_at_the_edge_count_as_a_tenth_of_a_metre)
{
    double near = obstruction_edge_parameter(0.2, 0.1, 20, 0.004);
    assert_close(obstruction_edge_parameter(0.2, 0, 20, 0.004), near, 0);
    assert_close(obstruction_edge_parameter(0.2, 20, 1e-9, 0.004), near, 0);
    assert_near(near, 0.2 * sqrt(2 * 20.1 / (0.004 * 0.1 * 20)), 1e-15);
    assert_close(obstruction_edge_parameter(0, 0, 0, 0.004), 0, 0);
}

/* A line 2 cm beside a low box, along its side, and the same line one unit in the last place aside
 * to either end: half way it is above the top, so that the edge takes nothing. */
TEST(a_line_along_a_side_loses_what_lines_just_off_it_lose)
{
    static const struct vec2 box[] = {{10, -2}, {20, -2}, {20, -0.02}, {10, -0.02}};
    const struct obstruction_heights low = {.top_m = 0.75}, high = {.top_m = 3};
    for (int step = -2; step <= 2; step++) {
        struct obstruction_line line = {{0, 0}, {40, step * 0x1p-50}, 0.5, 3};
        assert_close(obstruction_of(box, 4, low, &line, 0.0039).factor, 1, 0);
        double parameter = obstruction_edge_parameter(-0.02, 20, 20, 0.0039);
        assert_close(obstruction_of(box, 4, high, &line, 0.0039).factor,
                     obstruction_edge_amplitude_factor(parameter), 1e-12);
    }
}
