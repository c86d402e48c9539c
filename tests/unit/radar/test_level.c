#include "check.h"

#include "base/units.h"
#include "radar/level.h"

enum { LINES = 40000 };

static struct random_address line_of(uint64_t item)
{
    return (struct random_address){.seed = 7, .scene = 3, .item = item};
}

static double on_line(uint64_t item, double x)
{
    struct random_address line = line_of(item);
    return level_on_line(&line, RANDOM_OWN, x);
}

static double on_turn(uint64_t item, double x, double y, int64_t turn)
{
    struct random_address plane = line_of(item);
    return level_on_turn(&plane, RANDOM_OWN, x, y, turn);
}

/* Of a standard normal g, g^2 has the variance 2 and g^4 the mean 3 and the variance 96. */
TEST(a_level_is_standard_normal_at_every_place)
{
    static const double places[] = {0, 0.1, 0.5, 0.9, 1, 17.3, -2.6, 1e9 + 0.25};
    for (size_t i = 0; i < COUNT(places); i++)
        for (int plane = 0; plane < 2; plane++) {
            double mean = 0, square = 0, fourth = 0;
            for (uint64_t item = 0; item < LINES; item++) {
                double x = places[i], turned = x - 40 * floor(x / 40);
                double g = plane ? on_turn(item, turned, x + 0.3, 40) : on_line(item, x);
                mean += g / LINES;
                square += g * g / LINES;
                fourth += g * g * g * g / LINES;
            }
            assert_close(mean, 0, 5 * sqrt(1.0 / LINES));
            assert_close(square, 1, 5 * sqrt(2.0 / LINES));
            assert_close(fourth, 3, 5 * sqrt(96.0 / LINES));
        }
}

/* The overlap of two half cosines as wide as two knots. */
static double correlation(double knots)
{
    return knots < 2 ? (1 - knots / 2) * cos(PI * knots / 2) + sin(PI * knots / 2) / PI : 0;
}

TEST(places_are_as_alike_as_weights_overlap)
{
    static const double apart[] = {0.05, 0.5, 1, 1.5, 2, 5};
    assert_close(correlation(1), 1 / PI, 1e-15);
    for (size_t i = 0; i < COUNT(apart); i++) {
        double line = 0, plane = 0, both = 0;
        for (uint64_t item = 0; item < LINES; item++) {
            double uniform[4];
            struct random_address address = line_of(item);
            random_uniform(&address, RANDOM_TRAFFIC, 0, uniform);
            double x = 100 * uniform[0], y = 100 * uniform[1], d = apart[i];
            line += on_line(item, x) * on_line(item, x + d) / LINES;
            plane += on_turn(item, x, y, 200) * on_turn(item, x, y + d, 200) / LINES;
            both += on_turn(item, x, y, 200) * on_turn(item, x + d, y + d, 200) / LINES;
        }
        assert_close(line, correlation(apart[i]), 5 * sqrt(2.0 / LINES));
        assert_close(plane, correlation(apart[i]), 5 * sqrt(2.0 / LINES));
        assert_close(both, correlation(apart[i]) * correlation(apart[i]), 5 * sqrt(2.0 / LINES));
    }
}

/* No slope is steeper than pi/2 times the largest knots around, all below 9. */
TEST(a_level_has_no_step)
{
    const double hair = 1e-9;
    for (int knot = -50; knot < 50; knot++) {
        assert_close(on_line(1, knot - hair), on_line(1, knot + hair), 36 * hair);
        assert_close(on_turn(1, 3.7, knot - hair, 9), on_turn(1, 3.7, knot + hair, 9), 72 * hair);
    }
    for (int knot = 1; knot < 9; knot++)
        assert_close(on_turn(1, knot - hair, 0.4, 9), on_turn(1, knot + hair, 0.4, 9), 72 * hair);
}

TEST(a_turn_closes)
{
    for (int64_t turn = 2; turn < 40; turn++) {
        double end = (double)turn;
        assert_close(on_turn(5, end, 2.2, turn), on_turn(5, 0, 2.2, turn), 0);
        assert_close(on_turn(5, end - 1e-9, 2.2, turn), on_turn(5, 0, 2.2, turn), 1e-7);
    }
}

TEST(a_level_depends_on_its_address_and_not_on_the_frame)
{
    struct random_address line = line_of(2), later = line;
    later.frame = 9;
    assert_close(level_on_line(&later, RANDOM_OWN, 4.3), on_line(2, 4.3), 0);
    assert_true(level_on_line(&line, RANDOM_OWN + 1, 4.3) != on_line(2, 4.3));
    assert_true(on_line(3, 4.3) != on_line(2, 4.3));
}

/* The power of a level of deviation s has the variance exp((ln 10/10)^2 s^2) - 1. */
TEST(the_mean_of_the_power_is_1)
{
    double power = 0, sigma_db = 4;
    for (uint64_t item = 0; item < LINES; item++)
        power += pow(10, (level_mean_db(sigma_db) + sigma_db * on_line(item, 0.7)) / 10) / LINES;
    double nepers = sigma_db * log(10) / 10;
    assert_close(power, 1, 5 * sqrt((exp(nepers * nepers) - 1) / LINES));
    assert_close(level_mean_db(8), -7.368, 5e-4);
}
