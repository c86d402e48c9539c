#include "actors.h"

#include "text/record_write.h"
#include "traffic/scenario.h"

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
