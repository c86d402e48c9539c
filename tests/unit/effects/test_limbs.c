#include "support/effect_bench.h"

enum { FRAMES = 600 };

/* The torso of a person 20 m away, 0.2 rad to the left, who walks in the direction of 1 rad. */
static struct echo torso(void)
{
    struct echo echo = effect_bench_echo(20);
    echo.moving_part = MOVING_LIMBS;
    echo.ground_rate_mps = 1.4;
    echo.azimuth_rad = 0.2;
    echo.heading_rad = 1;
    return echo;
}

/* P(X <= x) of the triangular distribution from -1 to 1.5 with its peak at 0. */
static double triangle(double x)
{
    return x < 0 ? (x + 1) * (x + 1) / 2.5 : 1 - (1.5 - x) * (1.5 - x) / 3.75;
}

EFFECT_TEST(limbs_have_the_count_the_swing_and_the_place_of_their_draws)
{
    static const double border[] = {0.6065306597126334, 0.9097959895689501, 0.9856123220330293};
    size_t all = 0;
    for (bench->frame.frame = 0; bench->frame.frame < FRAMES; bench->frame.frame++) {
        const struct echo parent = torso();
        struct echo_span limbs = effect_bench_added(bench, EVERY_EFFECT, parent);
        double uniform[4];
        effect_bench_draw(bench, &parent, effect_limbs.purposes[0], 0, uniform);
        assert_true(uniform[0] < 0.998); /* a Poisson count of mean 0.5 is at most 3 up to here */
        assert_int_equal(limbs.count, (uniform[0] > border[0]) + (uniform[0] > border[1]) +
                                          (uniform[0] > border[2]));
        for (size_t i = 0; i < limbs.count; i++) {
            const struct echo *limb = &limbs.items[i];
            effect_bench_draw(bench, &parent, effect_limbs.purposes[0], (uint32_t)i + 1, uniform);
            double offset_m = 0.35 * (2 * uniform[1] - 1);
            double x_m = 20 * cos(0.2) + offset_m * cos(1), y_m = 20 * sin(0.2) + offset_m * sin(1);
            assert_near(limb->range_m, hypot(x_m, y_m), 1e-14);
            assert_close(limb->azimuth_rad, atan2(y_m, x_m), 1e-14);
            assert_close(triangle((limb->range_rate_mps + 3) / 1.4), uniform[0], 1e-12);
            assert_near(limb->ercs, pow(10, -0.3), 1e-15);
            assert_int_equal(limb->id.path, PATH_LIMB);
            assert_int_equal(limb->id.number, i + 1);
            assert_true(limb->effects == EFFECT_BIT(EFFECT_LIMBS));
        }
        all += limbs.count;
    }
    assert_true(all > FRAMES / 3);
}

EFFECT_TEST(a_person_who_does_not_walk_along_the_sight_line_has_no_limbs)
{
    struct echo still = torso(), wheel = torso();
    still.ground_rate_mps = 0;
    wheel.moving_part = MOVING_WHEEL;
    uint64_t limbs = EFFECT_BIT(EFFECT_LIMBS);
    for (bench->frame.frame = 0; bench->frame.frame < FRAMES; bench->frame.frame++) {
        assert_int_equal(effect_bench_added(bench, limbs, still).count, 0);
        assert_int_equal(effect_bench_added(bench, limbs, wheel).count, 0);
        assert_int_equal(effect_bench_added(bench, EVERY_EFFECT & ~limbs, torso()).count, 0);
    }
}
