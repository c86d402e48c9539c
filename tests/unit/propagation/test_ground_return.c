#include "check.h"

#include "base/units.h"
#include "geometry/kinematics.h"
#include "geometry/motion.h"
#include "propagation/ground_return.h"
#include "sample.h"

TEST(places_are_even_over_the_area)
{
    assert_near(ground_return_area_m2(0, 10, 2 * PI), 100 * PI, 1e-15);
    assert_near(ground_return_area_m2(5, 10, PI), 37.5 * PI, 1e-15);
    assert_close(ground_return_area_m2(7, 7, 1), 0, 0);
    /* As many nearer as there is area nearer. */
    uint64_t sample = 99;
    for (int i = 0; i < 10000; i++) {
        double least_m = sample_between(&sample, 0, 20), most_m = sample_between(&sample, 20, 200);
        double uniform = sample_between(&sample, 0, 1);
        double range_m = ground_return_range_m(least_m, most_m, uniform);
        assert_close(ground_return_area_m2(least_m, range_m, 1) /
                         ground_return_area_m2(least_m, most_m, 1),
                     uniform, 1e-12);
    }
    assert_close(ground_return_range_m(0, 30, 0x1p-53), 0, 1e-6);
    assert_close(ground_return_range_m(0.3, 30, 1 - 0x1p-53), 30, 1e-13);
    for (double range_m = 0.1; range_m < 10; range_m += 0.1)
        assert_close(ground_return_range_m(range_m, range_m, 0.3), range_m, 0);
}

/* MODEL 14.13: 20 m/s, 0.3 rad/s, a sensor at (3.6, 0.7), the sight line at 40 degrees. */
TEST(the_standing_world_recedes_by_the_sensors_own_motion)
{
    struct motion ego = {.velocity_mps = {20, 0}, .yaw_rate_radps = 0.3};
    struct vec2 sensor_mps = motion_velocity_at(&ego, (struct vec2){3.6, 0.7}), ahead = {1, 0};
    assert_close(ground_return_range_rate_mps(sensor_mps, ahead, 40 * DEGREE), -15.854230, 5e-7);
    assert_close(ground_return_range_rate_mps(ego.velocity_mps, ahead, 40 * DEGREE), -15.320889,
                 5e-7);
    struct vec2 aside = vec2_heading(65 * DEGREE);
    assert_close(ground_return_range_rate_mps(sensor_mps, aside, -25 * DEGREE), -15.854230, 5e-7);
    /* The same as a standing point seen there. */
    struct vec2 point = vec2_scale(17, vec2_heading(0.3)), still = {0, 0};
    struct kinematics sight = kinematics_of(still, sensor_mps, aside, point, still);
    assert_near(ground_return_range_rate_mps(sensor_mps, aside, sight.azimuth_rad),
                sight.range_rate_mps, 1e-14);
    assert_close(ground_return_range_rate_mps(still, ahead, 1), 0, 0);
}
