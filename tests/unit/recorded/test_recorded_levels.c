#include "check.h"

#include "recorded/recorded_levels.h"

static const double unknown = (double)NAN;

/* A body at a place that heads along x, or with across along y. */
static struct recorded_level body(double x_m, double y_m, double z_m, double slope, bool across)
{
    return (struct recorded_level){.place_m = {x_m, y_m},
                                   .heading = {across ? 0 : 1, across ? 1 : 0},
                                   .z_m = z_m,
                                   .slope = slope};
}

/* Compares whether bodies are on the road of body 0 with a text, "x" for yes and "." for no. */
static void assert_on(const struct recorded_level *bodies, const char *expected)
{
    enum { MOST = 32 };
    char found[MOST + 1] = "";
    bool on[MOST];
    size_t count = strlen(expected);
    assert_in_range(count, 1, MOST);
    recorded_levels_mark(bodies, count, 0, on, check_arena());
    for (size_t i = 0; i < count; i++)
        found[i] = on[i] ? 'x' : '.';
    assert_string_equal(found, expected);
}

TEST(a_hill_of_6_percent_keeps_a_lone_car_at_250_m)
{
    const struct recorded_level up[] = {body(0, 0, 0, 0.06, false), body(250, 0, 15, 0.06, false),
                                        body(-250, 3, -15, 0.06, false)};
    assert_on(up, "xxx");
    const struct recorded_level others_slope[] = {body(0, 0, 0, unknown, false),
                                                  body(250, 0, 15, 0.06, false)};
    assert_on(others_slope, "xx");
    struct recorded_level oncoming = body(250, 3, 15, -0.06, false);
    oncoming.heading.x = -1;
    const struct recorded_level both_ways[] = {body(0, 0, 0, 0.06, false), oncoming};
    assert_on(both_ways, "xx");
}

TEST(a_bridge_at_6_m_keeps_none)
{
    const struct recorded_level under[] = {
        body(0, 0, 0, 0, false),     body(0, 0, 6, 0, true),     body(40, -30, 6, 0, true),
        body(250, 5, 6, 0.04, true), body(120, 0, 6, 0, false),  body(80, 3, 0, 0, false),
        body(80, 3, 6, 0, true),     body(30, 40, 3.1, 0, true), body(30, 40, 2.9, 0, true)};
    assert_on(under, "x....x..x");
    const struct recorded_level over[] = {body(0, 0, 6, 0, false), body(0, 0, 0, 0, true),
                                          body(60, 0, 6, 0, false), body(60, 2, 0, 0, true)};
    assert_on(over, "x.x.");
}

TEST(a_bridge_over_a_hill_keeps_none)
{
    const struct recorded_level bodies[] = {body(0, 0, 0, 0.06, false), body(100, 0, 12, 0, true),
                                            body(100, 3, 6, 0.06, false), body(100, -3, 6, 0, true),
                                            body(100, 5, 0, 0, true)};
    assert_on(bodies, "x.xx.");
}

TEST(who_drives_up_a_ramp_has_left_the_road_below)
{
    const struct recorded_level bodies[] = {body(0, 0, 3.5, 0.06, false), body(60, 0, 0, 0, true),
                                            body(42, 1, 6, 0, false), body(-60, 0, 0, 0, false),
                                            body(10, 20, 0, 0, false)};
    assert_on(bodies, "x.xx.");
}

TEST(between_two_slopes_any_rise_is_that_of_a_road)
{
    const double heights_m[] = {9.1, 8.9, -2.9, -3.1};
    for (size_t i = 0; i < 4; i++) {
        const struct recorded_level bodies[] = {body(0, 0, 0, 0.06, false),
                                                body(100, 0, heights_m[i], 0, false)};
        assert_on(bodies, i == 1 || i == 2 ? "xx" : "x.");
    }
}

TEST(vehicles_lead_over_a_crest)
{
    /* z = 8 sin(x / 60 m) from a crest to a valley; the far car alone would be on another road. */
    const struct recorded_level crest[] = {
        body(0, 0, 8, 0, false), body(47, 0, 5.66, -0.0943, false), body(94, 0, 0, -0.133, false),
        body(141, 0, -5.66, -0.0943, false), body(188, 0, -8, 0, false)};
    assert_on(crest, "xxxxx");
    const struct recorded_level alone[] = {crest[0], crest[4]};
    assert_on(alone, "x.");
    const struct recorded_level in_any_order[] = {crest[0], crest[4], crest[2], crest[3], crest[1]};
    assert_on(in_any_order, "xxxxx");
    /* Farther bodies change nothing. */
    const struct recorded_level nearer[] = {crest[0], crest[1], crest[2]};
    assert_on(nearer, "xxx");
}

TEST(a_queue_that_has_never_moved_leads_up_a_hill)
{
    struct recorded_level queue[20];
    for (size_t i = 0; i < 20; i++)
        queue[i] = body(9 * (double)i, 0, 0.54 * (double)i, unknown, false);
    assert_on(queue, "xxxxxxxxxxxxxxxxxxxx");
    queue[10].z_m += 6;
    assert_on(queue, "xxxxxxxxxx.xxxxxxxxx");
    for (size_t i = 0; i < 20; i++)
        queue[i] = body(25 * (double)i, 0, 2.9 * (double)i, unknown, false);
    assert_on(queue, "xxxxxxxxxxxxxxxxxxxx");
}

TEST(a_ramp_does_not_lead_to_the_bridge_over_the_ego)
{
    const struct recorded_level bodies[] = {
        body(0, 0, 0, 0, false), body(20, -10, 1.2, 0.06, false), body(45, -10, 2.7, 0.06, false),
        body(70, -10, 4.2, 0.06, false), body(80, -4, 6, 0, true)};
    assert_on(bodies, "xxxx.");
}

TEST(a_body_without_a_height_is_on_every_road)
{
    const struct recorded_level bodies[] = {body(0, 0, 0, 0, false), body(9, 0, unknown, 0, false),
                                            body(9, 0, 9, 0, false)};
    assert_on(bodies, "xx.");
    const struct recorded_level from[] = {bodies[1], bodies[0], bodies[2]};
    assert_on(from, "xxx");
}

TEST(of_a_thing_any_part_may_be_on_the_road)
{
    struct recorded_level cellar = body(30, 9, -6, unknown, false),
                          lamp = body(30, -9, 6, unknown, false);
    cellar.tall_m = 20;
    lamp.tall_m = 4;
    const struct recorded_level bodies[] = {body(0, 0, 0, 0, false), cellar, lamp};
    assert_on(bodies, "xx.");
    struct recorded_level mast = body(100, 2, 0, unknown, false);
    mast.tall_m = 8;
    const struct recorded_level no_way_up[] = {bodies[0], mast, body(100, 4, 6, 0, true)};
    assert_on(no_way_up, "xx.");
}

TEST(the_slope_is_that_of_the_last_metres)
{
    struct recorded_climb climb = {0, 0};
    assert_true(isnan(recorded_levels_slope(climb)));
    climb = recorded_levels_climb(climb, 0.4, 0.02);
    assert_true(isnan(recorded_levels_slope(climb)));
    for (int i = 0; i < 100; i++)
        climb = recorded_levels_climb(climb, 1, 0.05);
    assert_close(recorded_levels_slope(climb), 0.05, 1e-9);
    for (int i = 0; i < 5; i++)
        climb = recorded_levels_climb(climb, 1, 0);
    assert_close(recorded_levels_slope(climb), 0.05 * exp(-1), 1e-9);
    climb = recorded_levels_climb(climb, 0, 0); /* at rest */
    assert_close(recorded_levels_slope(climb), 0.05 * exp(-1), 1e-9);
    for (int i = 0; i < 100; i++)
        climb = recorded_levels_climb(climb, -1, 0.02); /* backwards, and upward */
    assert_close(recorded_levels_slope(climb), -0.02, 1e-9);
}

TEST(a_pitch_of_zero_says_nothing)
{
    assert_close(recorded_levels_pitched(atan(0.06)), 0.06, 1e-12);
    assert_close(recorded_levels_pitched(-atan(0.12)), -0.12, 1e-12);
    assert_true(isnan(recorded_levels_pitched(0)));
    assert_true(isnan(recorded_levels_pitched(1.5)));
    assert_true(isnan(recorded_levels_pitched(unknown)));
}
