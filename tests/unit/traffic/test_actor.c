#include "actors.h"

TEST(an_object_without_segments_keeps_its_start)
{
    struct actor actor = driver(NULL, 0);
    actor.x_m = 3;
    actor.y_m = -4;
    actor.yaw_rad = PI / 2;
    struct motion body = motion_at(&actor, 1e5);
    check_place(body.position_m, 3, -4, 0);
    check_place(body.velocity_mps, 0, 0, 0);
    assert_close(body.yaw_rad, PI / 2, 0);
    assert_close(travelled_at(&actor, 1e5), 0, 0);
    actor.speed_mps = 30;
    body = motion_at(&actor, 2);
    check_place(body.position_m, 3, 56, 1e-14);
    check_place(body.velocity_mps, 0, 30, 1e-14);
    assert_close(travelled_at(&actor, 2), 60, 0);
}

TEST(a_constant_turn_is_a_circle)
{
    double radius_m = 50, speed_mps = 15, rate_radps = speed_mps / radius_m;
    struct segment turn = {.duration_s = 1000, .yaw_rate_radps = rate_radps};
    struct actor actor = driver(&turn, 1);
    actor.speed_mps = speed_mps;
    actor.x_m = 7;
    for (int i = 0; i <= 1000; i++) {
        double time_s = 0.37 * i, angle_rad = rate_radps * time_s;
        struct motion body = motion_at(&actor, time_s);
        check_place(body.position_m, 7 + radius_m * sin(angle_rad), radius_m * (1 - cos(angle_rad)),
                    1e-11);
        check_place(body.velocity_mps, speed_mps * cos(angle_rad), speed_mps * sin(angle_rad),
                    1e-12);
        assert_close(remainder(body.yaw_rad - angle_rad, 2 * PI), 0, 1e-13);
        assert_true(body.yaw_rad > -PI && body.yaw_rad <= PI);
        assert_close(travelled_at(&actor, time_s), speed_mps * time_s, 1e-11);
    }
}

TEST(straight_braking_is_a_parabola_and_then_a_line)
{
    struct segment brake = {.duration_s = 3, .acceleration_mps2 = -4};
    struct actor actor = driver(&brake, 1);
    actor.speed_mps = 20;
    for (int i = 0; i <= 600; i++) {
        double time_s = 0.01 * i, braked_s = time_s < 3 ? time_s : 3;
        double x_m = 20 * braked_s - 2 * braked_s * braked_s + 8 * (time_s - braked_s);
        struct motion body = motion_at(&actor, time_s);
        check_place(body.position_m, x_m, 0, 1e-13);
        check_place(body.velocity_mps, 20 - 4 * braked_s, 0, 1e-14);
        assert_close(travelled_at(&actor, time_s), x_m, 1e-13);
    }
}

TEST(braking_beyond_standstill_reverses)
{
    struct segment brake = {.duration_s = 5, .acceleration_mps2 = -1};
    struct actor actor = driver(&brake, 1);
    actor.speed_mps = 2;
    actor.yaw_rad = PI / 2;
    static const struct {
        double time_s, y_m, speed_mps, travelled_m;
    } cases[] = {
        {0, 0, 2, 0}, {2, 2, 0, 2}, {4, 0, -2, 4}, {5, -2.5, -3, 6.5}, {7, -8.5, -3, 12.5},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct motion body = motion_at(&actor, cases[i].time_s);
        check_place(body.position_m, 0, cases[i].y_m, 1e-14);
        check_place(body.velocity_mps, 0, cases[i].speed_mps, 1e-15);
        assert_close(body.yaw_rad, PI / 2, 0);
        assert_close(travelled_at(&actor, cases[i].time_s), cases[i].travelled_m, 1e-14);
    }
}

TEST(segments_follow_one_another)
{
    struct segment segments[] = {
        {.duration_s = 2, .acceleration_mps2 = 5},
        {.duration_s = 0, .acceleration_mps2 = 1},
        {.duration_s = PI, .yaw_rate_radps = 0.5},
        {.duration_s = 4, .acceleration_mps2 = -2.5},
    };
    struct actor actor = driver(segments, COUNT(segments));
    static const struct {
        double time_s, x_m, y_m, vx_mps, vy_mps, yaw_rad, yaw_rate_radps, travelled_m;
    } cases[] = {
        {0, 0, 0, 0, 0, 0, 0, 0},
        {1, 2.5, 0, 5, 0, 0, 0, 2.5},
        {2, 10, 0, 10, 0, 0, 0.5, 10},
        {2 + PI, 30, 20, 0, 10, PI / 2, 0, 10 + 10 * PI},
        {6 + PI, 30, 40, 0, 0, PI / 2, 0, 30 + 10 * PI},
        {60 + PI, 30, 40, 0, 0, PI / 2, 0, 30 + 10 * PI},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct motion body = motion_at(&actor, cases[i].time_s);
        check_place(body.position_m, cases[i].x_m, cases[i].y_m, 2e-14);
        check_place(body.velocity_mps, cases[i].vx_mps, cases[i].vy_mps, 1e-14);
        assert_close(body.yaw_rad, cases[i].yaw_rad, 1e-15);
        assert_close(body.yaw_rate_radps, cases[i].yaw_rate_radps, 0);
        assert_close(travelled_at(&actor, cases[i].time_s), cases[i].travelled_m, 1e-13);
    }
}

TEST(a_line_of_waypoints_is_driven_evenly)
{
    struct waypoint waypoints[] = {
        {1, 5, 1}, {1.5, 6.5, 3}, {4, 14, 13}, {4.25, 14.75, 14}, {9, 29, 33}};
    struct actor actor = follower(waypoints, COUNT(waypoints));
    for (int i = 0; i <= 800; i++) {
        double time_s = 1 + 0.01 * i;
        struct motion body = motion_at(&actor, time_s);
        check_place(body.position_m, 5 + 3 * (time_s - 1), 1 + 4 * (time_s - 1), 1e-13);
        check_place(body.velocity_mps, 3, 4, 1e-13);
        assert_close(body.yaw_rad, atan2(4, 3), 1e-13);
        assert_close(body.yaw_rate_radps, 0, 1e-12);
        assert_close(travelled_at(&actor, time_s), 5 * (time_s - 1), 1e-12);
    }
}

/* The three-point formula is exact for parabolas, and so is the cubic between two waypoints with
 * exact velocities. */
TEST(inner_waypoints_of_a_parabola_lie_on_the_parabola)
{
    static const double times_s[] = {0, 1, 1.5, 4, 4.75, 6, 7};
    struct waypoint waypoints[COUNT(times_s)];
    for (size_t i = 0; i < COUNT(times_s); i++)
        waypoints[i] = (struct waypoint){times_s[i], 20 * times_s[i], times_s[i] * times_s[i]};
    struct actor actor = follower(waypoints, COUNT(waypoints));
    for (int i = 0; i < 500; i++) {
        double time_s = 1 + 0.01 * i;
        struct motion body = motion_at(&actor, time_s);
        check_place(body.position_m, 20 * time_s, time_s * time_s, 1e-12);
        check_place(body.velocity_mps, 20, 2 * time_s, 1e-12);
        assert_close(body.yaw_rate_radps, 40 / (400 + 4 * time_s * time_s), 1e-12);
    }
}

static struct actor winding(void)
{
    struct waypoint *waypoints = arena_get(check_arena(), sizeof WINDING);
    memcpy(waypoints, WINDING, sizeof WINDING);
    return follower(waypoints, COUNT(WINDING));
}

TEST(a_curve_goes_through_its_waypoints)
{
    struct actor actor = winding();
    for (size_t i = 0; i < COUNT(WINDING); i++)
        check_place(motion_at(&actor, WINDING[i].time_s).position_m, WINDING[i].x_m, WINDING[i].y_m,
                    1e-14);
}

TEST(a_curve_is_smooth_at_its_waypoints)
{
    struct actor actor = winding();
    for (size_t i = 1; i + 1 < COUNT(WINDING); i++) {
        struct motion before = motion_at(&actor, WINDING[i].time_s - 1e-10);
        struct motion at = motion_at(&actor, WINDING[i].time_s);
        struct motion after = motion_at(&actor, WINDING[i].time_s + 1e-10);
        check_place(before.position_m, at.position_m.x, at.position_m.y, 1e-8);
        check_place(after.position_m, at.position_m.x, at.position_m.y, 1e-8);
        check_place(before.velocity_mps, at.velocity_mps.x, at.velocity_mps.y, 1e-7);
        check_place(after.velocity_mps, at.velocity_mps.x, at.velocity_mps.y, 1e-7);
        assert_close(before.yaw_rad, after.yaw_rad, 1e-7);
    }
}

TEST(velocity_yaw_rate_and_way_are_derivatives_of_the_curve)
{
    struct actor actor = winding();
    for (int i = 0; i < 790; i++) {
        double time_s = 0.505 + 0.01 * i, step_s = 1e-5;
        struct motion before = motion_at(&actor, time_s - step_s);
        struct motion at = motion_at(&actor, time_s);
        struct motion after = motion_at(&actor, time_s + step_s);
        struct vec2 moved_m = vec2_sub(after.position_m, before.position_m);
        check_place(at.velocity_mps, moved_m.x / (2 * step_s), moved_m.y / (2 * step_s), 1e-8);
        assert_close(at.yaw_rad, atan2(at.velocity_mps.y, at.velocity_mps.x), 1e-15);
        double turned_rad = remainder(after.yaw_rad - before.yaw_rad, 2 * PI);
        assert_close(at.yaw_rate_radps, turned_rad / (2 * step_s), 1e-6);
    }
}

TEST(the_way_along_a_curve_is_that_of_its_chords)
{
    struct actor actor = winding();
    enum { CHORDS = 80000 };
    double sum_m = 0;
    struct vec2 last = motion_at(&actor, 0.5).position_m;
    for (int i = 1; i <= CHORDS; i++) {
        double time_s = 0.5 + 8.0 * i / CHORDS;
        struct vec2 place = motion_at(&actor, time_s).position_m;
        sum_m += vec2_length(vec2_sub(place, last));
        last = place;
        if (i % 1000 == 0)
            assert_close(travelled_at(&actor, time_s), sum_m, 2e-3 * sum_m);
    }
    assert_close(travelled_at(&actor, 1e3), travelled_at(&actor, 8.5), 0);
    assert_close(travelled_at(&actor, 0.25), 0, 0);
}

TEST(outside_its_waypoints_an_object_stands)
{
    struct waypoint waypoints[] = {{2, 1, 1}, {3, 1, 5}, {4, -3, 5}};
    struct actor actor = follower(waypoints, COUNT(waypoints));
    struct motion before = motion_at(&actor, 0);
    check_place(before.position_m, 1, 1, 0);
    check_place(before.velocity_mps, 0, 0, 0);
    assert_close(before.yaw_rad, PI / 2, 1e-15);
    assert_close(before.yaw_rate_radps, 0, 0);
    struct motion after = motion_at(&actor, 4.5);
    check_place(after.position_m, -3, 5, 1e-15);
    check_place(after.velocity_mps, 0, 0, 0);
    assert_close(after.yaw_rad, PI, 1e-15);
    assert_close(after.yaw_rate_radps, 0, 0);
}

/* East, a stop, then north: while the object stands it points to where it goes next. */
TEST(between_equal_waypoints_an_object_stands)
{
    struct waypoint waypoints[] = {{0, 0, 0},  {2, 10, 0}, {3, 10, 0},
                                   {5, 10, 0}, {7, 10, 8}, {9, 10, 8}};
    struct actor actor = follower(waypoints, COUNT(waypoints));
    static const struct {
        double time_s, x_m, y_m, yaw_rad, travelled_m;
    } cases[] = {
        {1.999, 10, 0, 0, 10},  {2, 10, 0, PI / 2, 10}, {2.5, 10, 0, PI / 2, 10},
        {4, 10, 0, PI / 2, 10}, {5, 10, 0, PI / 2, 10}, {6, 10, 4, PI / 2, 14},
        {7, 10, 8, PI / 2, 18}, {8, 10, 8, PI / 2, 18}, {20, 10, 8, PI / 2, 18},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct motion body = motion_at(&actor, cases[i].time_s);
        check_place(body.position_m, cases[i].x_m, cases[i].y_m, 1e-5);
        assert_close(body.yaw_rad, cases[i].yaw_rad, 1e-9);
        assert_close(travelled_at(&actor, cases[i].time_s), cases[i].travelled_m, 1e-5);
    }
    for (int i = 0; i <= 300; i++) {
        struct motion body = motion_at(&actor, 2 + 0.01 * i);
        check_place(body.position_m, 10, 0, 1e-14);
        check_place(body.velocity_mps, 0, 0, 0);
        assert_close(body.yaw_rate_radps, 0, 0);
    }
}

/* There and back on a line: the object passes the waypoint in the middle at speed 0. */
TEST(at_a_turning_point_an_object_points_where_it_goes_next)
{
    struct waypoint waypoints[] = {{0, 0, 0}, {2, 10, 0}, {4, 0, 0}, {5, 0, 0}};
    struct actor actor = follower(waypoints, COUNT(waypoints));
    assert_close(motion_at(&actor, 1.9).yaw_rad, 0, 1e-15);
    assert_close(motion_at(&actor, 2 - 1e-8).yaw_rad, PI, 1e-15);
    assert_close(motion_at(&actor, 2).yaw_rad, PI, 1e-15);
    assert_close(motion_at(&actor, 2 + 1e-8).yaw_rad, PI, 1e-15);
    assert_close(motion_at(&actor, 4.5).yaw_rad, PI, 1e-15);
    assert_close(travelled_at(&actor, 4.5), 20, 1e-12);
}

TEST(an_object_that_never_moves_keeps_its_yaw)
{
    struct waypoint waypoints[] = {{0, 4, 2}, {1, 4, 2}, {5, 4, 2}};
    struct actor actor = follower(waypoints, COUNT(waypoints));
    actor.yaw_rad = -1.25;
    for (int i = 0; i <= 60; i++) {
        struct motion body = motion_at(&actor, 0.1 * i);
        check_place(body.position_m, 4, 2, 0);
        assert_close(body.yaw_rad, -1.25, 0);
        assert_close(body.yaw_rate_radps, 0, 0);
    }
    assert_close(travelled_at(&actor, 6), 0, 0);
}
