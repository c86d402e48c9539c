#include "check.h"

#include "base/random.h"
#include "base/units.h"
#include "propagation/micro_doppler.h"
#include "sample.h"

enum { STEPS = 100000 };

static double rate_at(double rolling_mps, double fraction, int step)
{
    struct wheel_point point = {fraction, 2 * PI * (step + 0.5) / STEPS};
    return micro_doppler_wheel_rate_mps(rolling_mps, rolling_mps, point);
}

/* MODEL 14.11: 50 km/h seen at 30 deg by a radar that stands. */
TEST(rates_spread_as_published)
{
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

/* MODEL 14.11. */
TEST(rates_gather_at_the_ends)
{
    double rolling_mps = 13.8889 * cos(30 * DEGREE), ends = 0, middle = 0;
    for (int k = 0; k < STEPS; k++) {
        double extra = rate_at(rolling_mps, 1, k) - rolling_mps;
        ends += fabs(extra) > 0.9 * rolling_mps;
        middle += fabs(extra) < 0.25;
    }
    assert_close(ends / STEPS, 0.287133, 3e-5);
    assert_close(middle / STEPS, 0.013233, 3e-5);
}

TEST(the_top_is_twice_as_fast_and_the_contact_point_stands)
{
    assert_close(micro_doppler_wheel_rate_mps(10, 10, (struct wheel_point){1, 0}), 20, 0);
    assert_close(micro_doppler_wheel_rate_mps(10, 10, (struct wheel_point){1, PI}), 0, 1e-15);
    /* Seen from a radar that drives along at the same speed. */
    assert_close(micro_doppler_wheel_rate_mps(0, 10, (struct wheel_point){1, PI}), -10, 1e-15);
}

TEST(the_hub_and_a_wheel_that_stands_have_the_rate_of_the_body)
{
    for (int k = 0; k < 100; k++) {
        struct wheel_point point = {0.01 * k, 0.1 * k};
        assert_close(micro_doppler_wheel_rate_mps(-3.7, 0, point), -3.7, 0);
        point.fraction = 0;
        assert_close(micro_doppler_wheel_rate_mps(-3.7, 9, point), -3.7, 0);
    }
}

TEST(points_are_drawn_evenly)
{
    for (int k = 0; k <= 10; k++) {
        struct wheel_point point = micro_doppler_wheel_point((double[2]){0.1 * k, 0.1 * k});
        assert_close(point.fraction, 0.3 + 0.07 * k, 1e-15);
        assert_close(point.angle_rad, 36 * k * DEGREE, 1e-14);
    }
}

TEST(one_and_a_half_points_show_on_average)
{
    double sum = 0, none = 0;
    for (int k = 0; k < STEPS; k++) {
        int64_t count = random_poisson(MICRO_DOPPLER_WHEEL_COUNT, (k + 0.5) / STEPS);
        sum += (double)count;
        none += count == 0;
    }
    assert_close(sum / STEPS, 1.5, 1e-4);
    assert_close(none / STEPS, exp(-1.5), 2e-5);
    assert_in_range(random_poisson(MICRO_DOPPLER_WHEEL_COUNT, RANDOM_MOST), 15, 25);
    assert_close(units_amplitude_db(MICRO_DOPPLER_WHEEL_FACTOR), -10, 1e-14);
}

/* A triangle over [a, b] with its peak at c: mean (a + b + c)/3, variance (a^2 + b^2 + c^2 - a b -
 * a c
 * - b c)/18, and (c - a)/(b - a) of it below the peak. */
TEST(swings_are_triangular)
{
    double mean = 0, squares = 0, backward = 0, before = -1;
    for (int k = 0; k < STEPS; k++) {
        double swing = micro_doppler_limb((double[2]){(k + 0.5) / STEPS, 0.5}).swing;
        assert_true(swing > before && swing < 1.5);
        before = swing;
        mean += swing / STEPS;
        squares += swing * swing / STEPS;
        backward += swing < 0;
    }
    assert_close(mean, 0.5 / 3, 1e-6);
    assert_close(squares - mean * mean, 4.75 / 18, 1e-6);
    assert_close(backward / STEPS, 0.4, 1e-5);
    for (double swing = -0.99; swing < 1.5; swing += 0.01) {
        double below =
            swing < 0 ? (swing + 1) * (swing + 1) / 2.5 : 1 - (1.5 - swing) * (1.5 - swing) / 3.75;
        assert_close(micro_doppler_limb((double[2]){below, 0.5}).swing, swing, 1e-14);
    }
}

TEST(limbs_reach_as_far_ahead_as_behind)
{
    assert_close(micro_doppler_limb((double[2]){0.5, RANDOM_LEAST}).offset_m, -0.35, 1e-15);
    assert_close(micro_doppler_limb((double[2]){0.5, 0.5}).offset_m, 0, 0);
    assert_close(micro_doppler_limb((double[2]){0.5, 0.75}).offset_m, 0.175, 1e-16);
    assert_close(micro_doppler_limb((double[2]){0.5, RANDOM_MOST}).offset_m, 0.35, 1e-15);
}

TEST(the_standing_foot_stands_and_the_other_overtakes)
{
    assert_close(micro_doppler_limb_rate_mps(1.4, 1.4, (struct limb){-1, 0}), 0, 0);
    assert_close(micro_doppler_limb_rate_mps(1.4, 1.4, (struct limb){1.5, 0}), 3.5, 1e-15);
    /* Towards a radar that drives at 10 m/s. */
    assert_close(micro_doppler_limb_rate_mps(-11.4, -1.4, (struct limb){-1, 0}), -10, 1e-15);
    assert_close(micro_doppler_limb_rate_mps(-11.4, 0, (struct limb){1.2, 0}), -11.4, 0);
}

TEST(limbs_move_between_the_standing_foot_and_two_and_a_half_times_the_torso)
{
    uint64_t sample = 18;
    static const double ends[2] = {RANDOM_LEAST, RANDOM_MOST};
    for (int i = 0; i < 100000; i++) {
        double torso = sample_between(&sample, -30, 30), walking = sample_between(&sample, -3, 3);
        double uniform[2] = {i < 2 ? ends[i] : sample_between(&sample, 0, 1), 0.5};
        double rate = micro_doppler_limb_rate_mps(torso, walking, micro_doppler_limb(uniform));
        double standing = torso - walking, fastest = torso + 1.5 * walking;
        assert_true(rate >= fmin(standing, fastest) && rate <= fmax(standing, fastest));
    }
}

TEST(every_other_person_shows_a_limb_on_average)
{
    double sum = 0, none = 0;
    for (int k = 0; k < STEPS; k++) {
        int64_t count = random_poisson(MICRO_DOPPLER_LIMB_COUNT, (k + 0.5) / STEPS);
        sum += (double)count;
        none += count == 0;
    }
    assert_close(sum / STEPS, 0.5, 1e-4);
    assert_close(none / STEPS, exp(-0.5), 2e-5);
    assert_in_range(random_poisson(MICRO_DOPPLER_LIMB_COUNT, RANDOM_MOST), 10, 20);
    assert_close(units_amplitude_db(MICRO_DOPPLER_LIMB_FACTOR), -6, 1e-14);
}
