#include "check.h"

#include "traffic/road_traffic.h"

/* Table I of the publication. */
static const struct road_driver PUBLISHED = {
    .speed_mps = 120 / 3.6,
    .headway_s = 1.6,
    .gap_m = 2,
    .acceleration_mps2 = 0.73,
    .deceleration_mps2 = 1.67,
};
#define LENGTH_M 5.0

/* Where a (1 - (v/v0)^4 - ((s0 + vT)/s)^2) vanishes. */
static double equilibrium_gap_m(const struct road_driver *driver, double speed_mps)
{
    return (driver->gap_m + speed_mps * driver->headway_s) /
           sqrt(1 - pow(speed_mps / driver->speed_mps, 4));
}

TEST(behind_a_leader_of_the_same_speed_the_published_gap_is_kept)
{
    assert_close(equilibrium_gap_m(&PUBLISHED, 0), 2, 0);
    for (double speed_mps = 0; speed_mps < 33.3; speed_mps += 0.1) {
        double gap_m = equilibrium_gap_m(&PUBLISHED, speed_mps);
        assert_close(road_traffic_acceleration_mps2(&PUBLISHED, speed_mps, gap_m, speed_mps), 0,
                     1e-12);
        assert_true(road_traffic_acceleration_mps2(&PUBLISHED, speed_mps, 1.01 * gap_m, speed_mps) >
                    0);
        assert_true(road_traffic_acceleration_mps2(&PUBLISHED, speed_mps, 0.99 * gap_m, speed_mps) <
                    0);
    }
}

/* The terms of the model one by one, with figures put in by hand. */
TEST(acceleration_is_that_of_the_published_formula)
{
    struct road_driver driver = {20, 1.5, 2, 1, 4};
    assert_close(road_traffic_acceleration_mps2(&driver, 0, (double)INFINITY, 0), 1, 0);
    assert_close(road_traffic_acceleration_mps2(&driver, 10, (double)INFINITY, 0), 1 - 1.0 / 16, 0);
    assert_close(road_traffic_acceleration_mps2(&driver, 10, 34, 10), 15.0 / 16 - 0.25, 1e-15);
    /* s* = 2 + 15 + 10 (10 - 4) / (2 sqrt(1 4)) = 32 */
    assert_close(road_traffic_acceleration_mps2(&driver, 10, 16, 4), 15.0 / 16 - 4, 1e-15);
    /* A leader that flees takes away no more than the headway: s* = 2. */
    assert_close(road_traffic_acceleration_mps2(&driver, 10, 4, 90), 15.0 / 16 - 0.25, 1e-15);
}

/* dv/dt = a (1 - (v/v0)^4) integrates to t = v0 / (2 a) (artanh x + arctan x), x = v / v0. */
TEST(speed_on_a_free_road_grows_as_the_closed_form)
{
    double place_m = 0, speed_mps = 0, step_s = 1.0 / 1024;
    for (int i = 1; i <= 60 * 1024; i++) {
        double acceleration =
            road_traffic_acceleration_mps2(&PUBLISHED, speed_mps, (double)INFINITY, speed_mps);
        road_traffic_move(&place_m, &speed_mps, acceleration, step_s);
        if (i % 1024 != 0)
            continue;
        double x = speed_mps / PUBLISHED.speed_mps;
        assert_near(PUBLISHED.speed_mps / (2 * PUBLISHED.acceleration_mps2) * (atanh(x) + atan(x)),
                    i * step_s, 1e-3);
    }
}

TEST(stops_are_exact_wherever_a_step_is_cut)
{
    static const double cuts_s[] = {0.1, 1.9, 2, 2.1, 5};
    for (size_t i = 0; i < COUNT(cuts_s); i++) {
        double place_m = 7, speed_mps = 6;
        road_traffic_move(&place_m, &speed_mps, -3, cuts_s[i]);
        assert_true(speed_mps >= 0);
        road_traffic_move(&place_m, &speed_mps, -3, 10 - cuts_s[i]);
        assert_close(place_m, 7 + 6 * 6 / (2 * 3.0), 1e-14);
        assert_close(speed_mps, 0, 0);
    }
    double place_m = 1, speed_mps = 0;
    road_traffic_move(&place_m, &speed_mps, -(double)INFINITY, 1);
    assert_close(place_m, 1, 0);
    assert_close(speed_mps, 0, 0);
}

/* Who drives up to something that stands ends gap_m before it, without braking much harder than is
 * comfortable. */
TEST(an_obstacle_is_approached_comfortably_to_the_gap)
{
    double place_m = 0, speed_mps = 30, hardest = 0, obstacle_m = 800;
    for (int i = 0; i < 300 * 16; i++) {
        double acceleration =
            road_traffic_acceleration_mps2(&PUBLISHED, speed_mps, obstacle_m - place_m, 0);
        hardest = fmin(hardest, speed_mps > 0 ? acceleration : 0);
        road_traffic_move(&place_m, &speed_mps, acceleration, 1.0 / 16);
        assert_true(speed_mps >= 0);
    }
    assert_true(hardest > -1.2 * PUBLISHED.deceleration_mps2);
    assert_close(speed_mps, 0, 0.02);
    assert_close(obstacle_m - place_m, 2, 0.15);
}

enum { RING = 40 };

/* The flow of vehicles that follow each other around a ring, after they have settled. The
 * acceleration is large, so that waves die out. */
static double ring_flow_per_s(struct road_driver driver, double density_per_m)
{
    double place_m[RING], speed_mps[RING] = {0}, acceleration[RING];
    double round_m = RING / density_per_m, start_m = 0, measured_s = 60, step_s = 1.0 / 16;
    for (int i = 0; i < RING; i++)
        place_m[i] = -i / density_per_m + 0.3 * sin(i);
    for (int step = 0; step < (600 + (int)measured_s) * 16; step++) {
        if (step == 600 * 16)
            for (int i = 0; i < RING; i++)
                start_m += place_m[i];
        for (int i = 0; i < RING; i++) {
            double leader_m = i > 0 ? place_m[i - 1] : place_m[RING - 1] + round_m;
            int leader = i > 0 ? i - 1 : RING - 1;
            acceleration[i] = road_traffic_acceleration_mps2(
                &driver, speed_mps[i], leader_m - LENGTH_M - place_m[i], speed_mps[leader]);
        }
        for (int i = 0; i < RING; i++)
            road_traffic_move(&place_m[i], &speed_mps[i], acceleration[i], step_s);
    }
    double sum_m = -start_m;
    for (int i = 0; i < RING; i++)
        sum_m += place_m[i];
    return sum_m / measured_s / round_m;
}

/* The fundamental diagram: at speed v a vehicle takes its length and the published gap, so density
 * is 1 / (l + s(v)) and flow is v times that. */
TEST(the_fundamental_diagram_is_that_of_the_published_gaps)
{
    struct road_driver driver = PUBLISHED;
    driver.acceleration_mps2 = 3;
    double most_per_h = 0;
    for (double speed_mps = 1; speed_mps <= 33; speed_mps += 2) {
        double density_per_m = 1 / (LENGTH_M + equilibrium_gap_m(&driver, speed_mps));
        double flow = ring_flow_per_s(driver, density_per_m);
        assert_near(flow, speed_mps * density_per_m, 2e-3);
        most_per_h = fmax(most_per_h, 3600 * flow);
    }
    /* The capacity is below 1 / T, which it would be without lengths and gaps. */
    assert_true(most_per_h > 1600 && most_per_h < 3600 / 1.6);
}
