#include "check.h"

#include "base/units.h"
#include "text/record_write.h"
#include "traffic/scenario.h"

static struct actor driver(struct segment *segments, size_t count)
{
    struct actor actor = {.id = "a", .class = "car"};
    actor.segments.items = segments;
    actor.segments.count = count;
    return actor;
}

static struct actor follower(struct waypoint *waypoints, size_t count)
{
    struct actor actor = {.id = "a", .class = "car"};
    actor.waypoints.items = waypoints;
    actor.waypoints.count = count;
    return actor;
}

static struct motion motion_at(const struct actor *actor, double time_s)
{
    double travelled_m;
    return scenario_motion(actor, time_s, &travelled_m);
}

static double travelled_at(const struct actor *actor, double time_s)
{
    double travelled_m;
    scenario_motion(actor, time_s, &travelled_m);
    return travelled_m;
}

static void check_place(struct vec2 place, double x_m, double y_m, double tolerance_m)
{
    assert_close(place.x, x_m, tolerance_m);
    assert_close(place.y, y_m, tolerance_m);
}

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

static const struct waypoint WINDING[] = {{0.5, 0, 0}, {2, 12, 3},  {2.6, 18, 1},
                                          {5, 25, 22}, {6, 20, 30}, {8.5, -3, 18}};

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

static struct scenario scenario_of(struct actor *actors, size_t count)
{
    struct scenario scenario = {.origin = "a test", .ego = "a", .rate_hz = 20, .duration_s = 10};
    scenario.objects.items = actors;
    scenario.objects.count = count;
    return scenario;
}

/* The tolerance is the rounding of the document's own numbers: half a step of 9.3e-10 m. */
TEST(a_shifted_scenario_moves_like_a_local_one)
{
    struct vec2 origin_m = {500000, 5300000};
    struct waypoint near[COUNT(WINDING)], far[COUNT(WINDING)];
    memcpy(near, WINDING, sizeof near);
    memcpy(far, WINDING, sizeof far);
    struct segment segments[] = {{3, 1.5, 0.1}, {4, -1, -0.3}};
    for (size_t i = 0; i < COUNT(far); i++) {
        near[i].x_m += 0.1;
        near[i].y_m -= 0.3;
        far[i].x_m = near[i].x_m + origin_m.x;
        far[i].y_m = near[i].y_m + origin_m.y;
    }
    struct actor local[] = {driver(segments, 2), follower(near, COUNT(near))};
    struct actor utm[] = {driver(segments, 2), follower(far, COUNT(far))};
    local[0].x_m = 12.34;
    local[0].y_m = -56.78;
    local[0].speed_mps = utm[0].speed_mps = 13;
    utm[0].x_m = 12.34 + origin_m.x;
    utm[0].y_m = -56.78 + origin_m.y;
    struct scenario scenario = scenario_of(utm, 2);
    scenario_shift(&scenario, origin_m);
    utm[1].id = "b";
    assert_done(scenario_check, &scenario);
    for (size_t i = 0; i < 2; i++)
        for (int j = 0; j <= 200; j++) {
            struct motion near_body = motion_at(&local[i], 0.05 * j);
            struct motion far_body = motion_at(&utm[i], 0.05 * j);
            check_place(far_body.position_m, near_body.position_m.x, near_body.position_m.y, 1e-9);
            check_place(far_body.velocity_mps, near_body.velocity_mps.x, near_body.velocity_mps.y,
                        i == 0 ? 0 : 5e-9);
        }
}

TEST(frames_are_counted_despite_rounding)
{
    static const struct {
        double rate_hz, duration_s;
        int64_t frames;
    } cases[] = {
        {25, 8, 201},
        {25, 7.999999, 200},
        {25, 8.039999, 201},
        {20, 0, 1},
        {20, 0.04, 1},
        {10, 0.3, 4},
        {10, 0.7, 8},
        {100, 0.29, 30},
        {100, 1.15, 116},
        {30, 0.1, 4},
        {0.1, 30, 4},
        {3, 1.0 / 3, 2},
        {17, 1000000.0 / 17, 1000001},
        {1e4, 1e6, 10000000001},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct scenario scenario = scenario_of(NULL, 0);
        scenario.rate_hz = cases[i].rate_hz;
        scenario.duration_s = cases[i].duration_s;
        assert_int_equal(scenario_frames(&scenario), cases[i].frames);
    }
    for (int rate_hz = 1; rate_hz <= 200; rate_hz++)
        for (int frame = 0; frame <= 500; frame++) {
            struct scenario scenario = scenario_of(NULL, 0);
            scenario.rate_hz = rate_hz;
            scenario.duration_s = (double)frame / rate_hz;
            assert_int_equal(scenario_frames(&scenario), frame + 1);
        }
}

TEST(contradictory_scenarios_are_refused)
{
    struct waypoint good[] = {{0, 0, 0}, {1, 1, 0}}, bad[] = {{0, 0, 0}, {2, 1, 0}, {2, 2, 0}};
    struct segment segment = {.duration_s = 1};
    struct actor plain = driver(NULL, 0), following = follower(good, 2);
    struct actor lonely = follower(good, 1), tangled = follower(bad, 3), torn = follower(good, 2);
    struct actor started = follower(good, 2);
    following.id = lonely.id = tangled.id = torn.id = started.id = "b";
    torn.segments.items = &segment;
    torn.segments.count = 1;
    started.speed_mps = 3;
    struct actor unnamed = plain;
    unnamed.id = "z";
    const struct {
        struct actor actors[2];
        const char *message;
    } cases[] = {
        {{plain, following}, NULL},
        {{plain, plain}, "objects[1].id: \"a\" is the id of objects[0] already"},
        {{unnamed, following}, "ego: \"a\" is not the id of an object"},
        {{plain, lonely}, "objects[1].waypoints: only one; expected two or more, or none"},
        {{plain, tangled},
         "objects[1].waypoints[2].time_s: 2 is not after the previous waypoint's 2"},
        {{plain, torn}, "objects[1].segments: expected none beside waypoints"},
        {{plain, started},
         "objects[1].waypoints: they give place and speed; expected no x_m, y_m, speed_mps"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct actor actors[] = {cases[i].actors[0], cases[i].actors[1]};
        struct scenario scenario = scenario_of(actors, 2);
        struct diag diag = {0};
        assert_int_equal(record_write_check(&scenario_record, &scenario, ~0U, &diag), 0);
        assert_int_equal(scenario_check(&scenario, &diag), cases[i].message == NULL ? 0 : -1);
        assert_string_equal(diag.text, cases[i].message == NULL ? "" : cases[i].message);
        assert_int_equal(diag.code, cases[i].message == NULL ? DIAG_OK : DIAG_CONFIG);
    }
}

TEST(a_scenario_knows_its_interferers)
{
    struct actor actors[] = {driver(NULL, 0)};
    struct interferer interferers[] = {{.object = "a"}, {.object = "nobody"}};
    struct scenario scenario = scenario_of(actors, 1);
    scenario.conditions.interferers.items = interferers;
    scenario.conditions.interferers.count = 1;
    assert_done(scenario_check, &scenario);
    scenario.conditions.interferers.count = 2;
    assert_refused(DIAG_CONFIG,
                   "conditions.interferers[1].object: \"nobody\" is not the id of an object",
                   scenario_check, &scenario);
}

TEST(values_outside_their_bounds_are_refused)
{
    struct waypoint waypoints[] = {{0, 1e9, -1e9}, {1, 0, 1.5e9}};
    struct actor actors[] = {driver(NULL, 0), follower(waypoints, 2)};
    struct scenario scenario = scenario_of(actors, 2);
    assert_refused(DIAG_DATA, "objects[1].waypoints[1].y_m: 1.5e+09 is outside [-1e9, 1e9] m",
                   record_write_check, &scenario_record, &scenario, ~0U);
    waypoints[1].y_m = 0;
    assert_done(record_write_check, &scenario_record, &scenario, ~0U);
    scenario.rate_hz = 0.05;
    assert_refused(DIAG_DATA, "rate_hz: 0.05 is outside [0.1, 10000] Hz", record_write_check,
                   &scenario_record, &scenario, ~0U);
}
