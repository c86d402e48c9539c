#include "geometry/kinematics.h"

#include "base/units.h"
#include "check.h"
#include "sample.h"

/* An ego at (10, 20) that drives along its heading (0.6, 0.8) and turns left by 0.5 rad/s. */
static struct motion turning_ego(void)
{
    return (struct motion){{10, 20}, {3, 4}, elementary_atan2(0.8, 0.6), 0.5};
}

static void assert_vector(struct vec2 actual, double x, double y)
{
    assert_close(actual.x, x, 1e-14);
    assert_close(actual.y, y, 1e-14);
}

TEST(a_sensor_stands_at_its_mount_turned_with_the_ego)
{
    const struct motion ego = turning_ego();
    struct sensor_pose front = kinematics_sensor_pose(&ego, 5, 0, 0);
    assert_vector(front.position_m, 13, 24);
    struct sensor_pose left_front = kinematics_sensor_pose(&ego, 5, 1, 0);
    assert_vector(left_front.position_m, 13 - 0.8, 24 + 0.6);
}

TEST(a_sensor_moves_with_the_ego_and_aside_with_its_turn)
{
    const struct motion ego = turning_ego();
    struct sensor_pose centre = kinematics_sensor_pose(&ego, 0, 0, 0);
    assert_vector(centre.velocity_mps, 3, 4);
    /* 5 m ahead, 0.5 rad/s: 2.5 m/s to the left, which is (-0.8, 0.6) */
    struct sensor_pose front = kinematics_sensor_pose(&ego, 5, 0, 0);
    assert_vector(front.velocity_mps, 3 - 2, 4 + 1.5);
    /* where it looks does not change how it moves */
    struct sensor_pose rear_looking = kinematics_sensor_pose(&ego, 5, 0, 3);
    assert_vector(rear_looking.velocity_mps, 1, 5.5);
}

TEST(a_sensor_looks_along_its_own_yaw_from_the_ego_s)
{
    const struct motion ego = turning_ego();
    assert_vector(kinematics_sensor_pose(&ego, 5, 1, 0).boresight, 0.6, 0.8);
    assert_vector(kinematics_sensor_pose(&ego, 5, 1, PI / 2).boresight, -0.8, 0.6);
    assert_vector(kinematics_sensor_pose(&ego, 5, 1, PI).boresight, -0.6, -0.8);
    assert_close(kinematics_sensor_pose(&ego, 5, 1, PI).yaw_rad, ego.yaw_rad + PI, 0);
}

/* A central difference of the mount's place 0.1 ms earlier and later. */
TEST(the_velocity_is_the_rate_of_change_of_the_position)
{
    uint64_t sample = 1;
    for (int i = 0; i < 1000; i++) {
        struct motion ego = {
            {sample_between(&sample, -100, 100), sample_between(&sample, -100, 100)},
            {sample_between(&sample, -40, 40), sample_between(&sample, -40, 40)},
            sample_between(&sample, -3, 3),
            sample_between(&sample, -1, 1)};
        double x_m = sample_between(&sample, -4, 4), y_m = sample_between(&sample, -1, 1);
        const double step_s = 1e-4;
        struct motion before = motion_after(ego, -step_s), after = motion_after(ego, step_s);
        struct vec2 moved_m = vec2_sub(kinematics_sensor_pose(&after, x_m, y_m, 0).position_m,
                                       kinematics_sensor_pose(&before, x_m, y_m, 0).position_m);
        struct vec2 velocity_mps = kinematics_sensor_pose(&ego, x_m, y_m, 0).velocity_mps;
        assert_close(moved_m.x / (2 * step_s), velocity_mps.x, 1e-6);
        assert_close(moved_m.y / (2 * step_s), velocity_mps.y, 1e-6);
    }
}
