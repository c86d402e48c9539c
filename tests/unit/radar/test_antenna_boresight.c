#include "check.h"

#include "base/units.h"
#include "propagation/ground_return.h"
#include "radar/antenna.h"
#include "sample.h"

static const struct boresight_error ONE_DEGREE = {.yaw_error_rad = DEGREE};

/* MODEL 14.8: one degree of yaw error puts what is straight ahead aside by this much. */
TEST(a_yaw_error_shifts_the_far_more)
{
    static const double cases[][2] = {{10, 0.174524}, {30, 0.523572}, {100, 1.745241}};
    for (size_t i = 0; i < COUNT(cases); i++)
        assert_close(cases[i][0] * sin(antenna_reported_rad(&ONE_DEGREE, 0)), cases[i][1], 5e-7);
}

/* MODEL 14.8: at 30 m/s what stands has another range rate than its reported azimuth says. */
TEST(the_standing_world_contradicts_a_yaw_error)
{
    static const double cases[][2] = {{30, 0.265743}, {0, 0.004569}};
    struct vec2 speed_mps = {30, 0}, ahead = {1, 0};
    for (size_t i = 0; i < COUNT(cases); i++) {
        double azimuth_rad = cases[i][0] * DEGREE;
        double reported_rad = antenna_reported_rad(&ONE_DEGREE, azimuth_rad);
        assert_close(ground_return_range_rate_mps(speed_mps, ahead, reported_rad) -
                         ground_return_range_rate_mps(speed_mps, ahead, azimuth_rad),
                     cases[i][1], 5e-7);
    }
}

TEST(a_radome_bends_with_its_period)
{
    struct boresight_error radome = {.bias_rad = 0.5 * DEGREE, .bias_period_rad = 24 * DEGREE};
    static const double cases[][2] = {{0, 0},     {2, 0.25}, {6, 0.5},   {12, 0},
                                      {18, -0.5}, {30, 0.5}, {-6, -0.5}, {-22, 0.25}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        double azimuth_rad = cases[i][0] * DEGREE;
        double bent_rad = antenna_reported_rad(&radome, azimuth_rad) - azimuth_rad;
        assert_close(bent_rad / DEGREE, cases[i][1], 1e-13);
    }
    radome.bias_phase_rad = 90 * DEGREE;
    radome.yaw_error_rad = -2 * DEGREE;
    assert_close(antenna_reported_rad(&radome, 0) / DEGREE, -1.5, 1e-14);
    assert_close(antenna_reported_rad(&radome, 8 * DEGREE) / DEGREE, 5.75, 1e-14);
}

TEST(error_and_bias_add_up_at_most)
{
    uint64_t sample = 14;
    for (int i = 0; i < 1000; i++) {
        struct boresight_error one = {.yaw_error_rad = sample_between(&sample, -0.05, 0.05),
                                      .bias_rad = sample_between(&sample, -0.03, 0.03),
                                      .bias_period_rad = sample_between(&sample, 0.3, 0.7),
                                      .bias_phase_rad = sample_between(&sample, -4, 4)};
        double most_possible_rad = fabs(one.yaw_error_rad) + fabs(one.bias_rad);
        double most_rad = 0;
        for (double azimuth_rad = -1.5; azimuth_rad < 1.5; azimuth_rad += 0.003)
            most_rad = fmax(most_rad, fabs(antenna_reported_rad(&one, azimuth_rad) - azimuth_rad));
        assert_true(most_rad <= most_possible_rad + 1e-15);
        assert_close(most_rad, most_possible_rad, 2e-5);
    }
}

TEST(a_true_sensor_reports_the_azimuth_itself)
{
    struct boresight_error none = {0};
    for (double azimuth_rad = -3.1; azimuth_rad < 3.1; azimuth_rad += 0.01)
        assert_close(antenna_reported_rad(&none, azimuth_rad), azimuth_rad, 0);
    /* Over the back it comes round. */
    assert_close(antenna_reported_rad(&ONE_DEGREE, PI), -PI + DEGREE, 1e-15);
}
