#include "check.h"

#include "random.h"
#include "sample.h"
#include "units.h"
#include "wheel.h"

#define DEGREE (PI / 180)

enum { STEPS = 100000 };

static double rate_at(double rolling_mps, double fraction, int step)
{
    struct wheel_point point = {fraction, 2 * PI * (step + 0.5) / STEPS};
    return wheel_range_rate_mps(rolling_mps, rolling_mps, point);
}

/* EFFECTS 8: 50 km/h seen at 30 deg by a radar that stands. */
static void rates_spread_as_published(void **state)
{
    (void)state;
    static const struct {
        double fraction, least, most, deviation;
    } rows[] = {{1, 0, 24.0563, 8.505180}, {0.7, 3.6084, 20.4478, 5.953626}};
    double rolling_mps = 13.8889 * cos(30 * DEGREE);
    for (size_t i = 0; i < 2; i++) {
        double squares = 0, least = 100, most = -100;
        for (int k = 0; k < STEPS; k++) {
            double rate = rate_at(rolling_mps, rows[i].fraction, k);
            squares += (rate - rolling_mps) * (rate - rolling_mps) / STEPS;
            least = fmin(least, rate);
            most = fmax(most, rate);
        }
        assert_close(sqrt(squares), rows[i].deviation, 8e-6);
        assert_close(least, rows[i].least, 1e-4);
        assert_close(most, rows[i].most, 1e-4);
    }
}

/* EFFECTS 8. */
static void rates_gather_at_the_ends(void **state)
{
    (void)state;
    double rolling_mps = 13.8889 * cos(30 * DEGREE), ends = 0, middle = 0;
    for (int k = 0; k < STEPS; k++) {
        double extra = rate_at(rolling_mps, 1, k) - rolling_mps;
        ends += fabs(extra) > 0.9 * rolling_mps;
        middle += fabs(extra) < 0.25;
    }
    assert_close(ends / STEPS, 0.287133, 3e-5);
    assert_close(middle / STEPS, 0.013233, 3e-5);
}

static void the_top_is_twice_as_fast_and_the_contact_point_stands(void **state)
{
    (void)state;
    assert_close(wheel_range_rate_mps(10, 10, (struct wheel_point){1, 0}), 20, 0);
    assert_close(wheel_range_rate_mps(10, 10, (struct wheel_point){1, PI}), 0, 1e-15);
    /* Seen from a radar that drives along at the same speed. */
    assert_close(wheel_range_rate_mps(0, 10, (struct wheel_point){1, PI}), -10, 1e-15);
}

static void the_hub_and_a_wheel_that_stands_have_the_rate_of_the_body(void **state)
{
    (void)state;
    for (int k = 0; k < 100; k++) {
        struct wheel_point point = {0.01 * k, 0.1 * k};
        assert_close(wheel_range_rate_mps(-3.7, 0, point), -3.7, 0);
        point.fraction = 0;
        assert_close(wheel_range_rate_mps(-3.7, 9, point), -3.7, 0);
    }
}

static void points_are_drawn_evenly(void **state)
{
    (void)state;
    for (int k = 0; k <= 10; k++) {
        struct wheel_point point = wheel_point((double[2]){0.1 * k, 0.1 * k});
        assert_close(point.fraction, 0.3 + 0.07 * k, 1e-15);
        assert_close(point.angle_rad, 36 * k * DEGREE, 1e-14);
    }
}

static void points_move_between_the_contact_point_and_the_top(void **state)
{
    (void)state;
    uint64_t sample = 8;
    for (int i = 0; i < 100000; i++) {
        double hub = sample_between(&sample, -50, 50), rolling = sample_between(&sample, -50, 50);
        double uniform[2] = {sample_between(&sample, 0, 1), sample_between(&sample, 0, 1)};
        double rate = wheel_range_rate_mps(hub, rolling, wheel_point(uniform));
        assert_true(fabs(rate - hub) <= fabs(rolling) * (1 + 1e-15) + 1e-14);
    }
}

static void one_and_a_half_points_show_on_average(void **state)
{
    (void)state;
    double sum = 0, none = 0;
    for (int k = 0; k < STEPS; k++) {
        int64_t count = wheel_count((k + 0.5) / STEPS);
        sum += (double)count;
        none += count == 0;
    }
    assert_close(sum / STEPS, 1.5, 1e-4);
    assert_close(none / STEPS, exp(-1.5), 2e-5);
    assert_in_range(wheel_count(RANDOM_MOST), 15, 25);
    assert_close(units_amplitude_db(WHEEL_AMPLITUDE_FACTOR), -10, 1e-14);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rates_spread_as_published),
        cmocka_unit_test(rates_gather_at_the_ends),
        cmocka_unit_test(the_top_is_twice_as_fast_and_the_contact_point_stands),
        cmocka_unit_test(the_hub_and_a_wheel_that_stands_have_the_rate_of_the_body),
        cmocka_unit_test(points_are_drawn_evenly),
        cmocka_unit_test(points_move_between_the_contact_point_and_the_top),
        cmocka_unit_test(one_and_a_half_points_show_on_average),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
