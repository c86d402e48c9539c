#include "check.h"

#include "limbs.h"
#include "random.h"
#include "sample.h"
#include "units.h"

enum { STEPS = 100000 };

/* A triangle over [a, b] with its peak at c: mean (a + b + c)/3, variance (a^2 + b^2 + c^2 - a b -
 * a c
 * - b c)/18, and (c - a)/(b - a) of it below the peak. */
static void swings_are_triangular(void **state)
{
    (void)state;
    double mean = 0, squares = 0, backward = 0, before = -1;
    for (int k = 0; k < STEPS; k++) {
        double swing = limbs_limb((double[2]){(k + 0.5) / STEPS, 0.5}).swing;
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
        assert_close(limbs_limb((double[2]){below, 0.5}).swing, swing, 1e-14);
    }
}

static void limbs_reach_as_far_ahead_as_behind(void **state)
{
    (void)state;
    assert_close(limbs_limb((double[2]){0.5, RANDOM_LEAST}).offset_m, -0.35, 1e-15);
    assert_close(limbs_limb((double[2]){0.5, 0.5}).offset_m, 0, 0);
    assert_close(limbs_limb((double[2]){0.5, 0.75}).offset_m, 0.175, 1e-16);
    assert_close(limbs_limb((double[2]){0.5, RANDOM_MOST}).offset_m, 0.35, 1e-15);
}

static void the_standing_foot_stands_and_the_other_overtakes(void **state)
{
    (void)state;
    assert_close(limbs_range_rate_mps(1.4, 1.4, (struct limb){-1, 0}), 0, 0);
    assert_close(limbs_range_rate_mps(1.4, 1.4, (struct limb){1.5, 0}), 3.5, 1e-15);
    /* Towards a radar that drives at 10 m/s. */
    assert_close(limbs_range_rate_mps(-11.4, -1.4, (struct limb){-1, 0}), -10, 1e-15);
    assert_close(limbs_range_rate_mps(-11.4, 0, (struct limb){1.2, 0}), -11.4, 0);
}

static void limbs_move_between_the_standing_foot_and_two_and_a_half_times_the_torso(void **state)
{
    (void)state;
    uint64_t sample = 18;
    static const double ends[2] = {RANDOM_LEAST, RANDOM_MOST};
    for (int i = 0; i < 100000; i++) {
        double torso = sample_between(&sample, -30, 30), walking = sample_between(&sample, -3, 3);
        double uniform[2] = {i < 2 ? ends[i] : sample_between(&sample, 0, 1), 0.5};
        double rate = limbs_range_rate_mps(torso, walking, limbs_limb(uniform));
        double standing = torso - walking, fastest = torso + 1.5 * walking;
        assert_true(rate >= fmin(standing, fastest) && rate <= fmax(standing, fastest));
    }
}

static void every_other_person_shows_a_limb_on_average(void **state)
{
    (void)state;
    double sum = 0, none = 0;
    for (int k = 0; k < STEPS; k++) {
        int64_t count = limbs_count((k + 0.5) / STEPS);
        sum += (double)count;
        none += count == 0;
    }
    assert_close(sum / STEPS, 0.5, 1e-4);
    assert_close(none / STEPS, exp(-0.5), 2e-5);
    assert_in_range(limbs_count(RANDOM_MOST), 10, 20);
    assert_close(units_amplitude_db(LIMBS_AMPLITUDE_FACTOR), -6, 1e-14);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(swings_are_triangular),
        cmocka_unit_test(limbs_reach_as_far_ahead_as_behind),
        cmocka_unit_test(the_standing_foot_stands_and_the_other_overtakes),
        cmocka_unit_test(limbs_move_between_the_standing_foot_and_two_and_a_half_times_the_torso),
        cmocka_unit_test(every_other_person_shows_a_limb_on_average),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
