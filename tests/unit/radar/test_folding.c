#include "check.h"

#include "base/units.h"
#include "radar/folding.h"
#include "sample.h"

static void assert_same_bits(double actual, double expected)
{
    assert_memory_equal(&actual, &expected, sizeof actual);
}

/* MODEL 14.16. */
TEST(folding_is_as_published)
{
    assert_close(folding_range_rate_mps(45, 0, 24.5), -4, 0);
    assert_close(folding_range_rate_mps(-60, 0, 24.5), -11, 0);
    assert_close(folding_range_m(100, 59.958492), 40.041508, 5.1e-7);
    /* From -55.5 to 111 m/s, as -200 to 400 km/h: 120 m/s are 166.5 less. */
    assert_close(folding_range_rate_mps(120, 27.75, 83.25), -46.5, 1e-13);
    assert_close(folding_range_rate_mps(-60, 27.75, 83.25), 106.5, 1e-13);
    assert_close(folding_range_rate_mps(110.9, 27.75, 83.25), 110.9, 0);
    assert_close(folding_range_rate_mps(111, 27.75, 83.25), -55.5, 0);
}

TEST(what_lies_inside_comes_back_bit_by_bit)
{
    uint64_t sample = 10;
    for (int i = 0; i < 100000; i++) {
        double unambiguous = sample_between(&sample, 1e-3, 100);
        double rate = sample_between(&sample, -unambiguous, unambiguous);
        assert_same_bits(folding_range_rate_mps(rate, 0, unambiguous), rate);
        assert_same_bits(folding_range_m(fabs(rate), unambiguous), fabs(rate));
    }
    static const double edges[] = {0.0, -0.0, 0x1p-1074, -0x1p-1074, -24.5, 1e-300};
    for (size_t i = 0; i < COUNT(edges); i++)
        assert_same_bits(folding_range_rate_mps(edges[i], 0, 24.5), edges[i]);
    assert_same_bits(folding_range_rate_mps(nextafter(24.5, 0), 0, 24.5), nextafter(24.5, 0));
    assert_same_bits(folding_range_rate_mps(1e9, 0, (double)INFINITY), 1e9);
    assert_same_bits(folding_range_m(1e9, (double)INFINITY), 1e9);
}

TEST(the_interval_holds_its_lower_end_only)
{
    for (int turn = -9; turn <= 9; turn += 2) {
        double end = turn * 24.5;
        assert_close(folding_range_rate_mps(end, 0, 24.5), -24.5, 0);
        assert_true(folding_range_rate_mps(nextafter(end, -1000), 0, 24.5) > 24.4);
        assert_true(folding_range_rate_mps(nextafter(end, -1000), 0, 24.5) < 24.5);
    }
    assert_close(folding_range_m(60, 60), 0, 0);
    assert_close(folding_range_m(180, 60), 0, 0);
    assert_true(folding_range_m(nextafter(180, 0), 60) < 60);
}

/* The formula with floor, which rounds on the way. */
TEST(folding_moves_by_whole_intervals)
{
    uint64_t sample = 11;
    for (int i = 0; i < 100000; i++) {
        double unambiguous = sample_between(&sample, 1, 100);
        double rate = sample_between(&sample, -500, 500);
        double folded = folding_range_rate_mps(rate, 0, unambiguous);
        assert_true(folded >= -unambiguous && folded < unambiguous);
        double whole = floor((rate + unambiguous) / (2 * unambiguous));
        assert_close(remainder(folded - (rate - whole * 2 * unambiguous), 2 * unambiguous), 0,
                     1e-12);
        double range_m = sample_between(&sample, 0, 500);
        double folded_m = folding_range_m(range_m, unambiguous);
        assert_true(folded_m >= 0 && folded_m < unambiguous);
        assert_close(remainder(folded_m - range_m, unambiguous), 0, 1e-12);
    }
}
