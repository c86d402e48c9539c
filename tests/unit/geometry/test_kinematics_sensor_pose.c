#include "geometry/kinematics.h"

#include "base/units.h"
#include "check.h"

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
    struct sensor_pose left_front = kinematics_sensor_pose(&ego, 5, 1, 0);
    assert_vector(left_front.velocity_mps, 3 - 2 - 0.3, 4 + 1.5 - 0.4);
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
