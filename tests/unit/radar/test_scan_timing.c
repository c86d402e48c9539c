#include "radar/scan_timing.h"

#include "check.h"

TEST(known_frames_have_known_instants)
{
    static const struct {
        double cycle_s, time_s, interval_s;
        enum scan_timing_answer answer;
        double instant_s;
    } cases[] = {
        /* once a frame */
        {0, 12.34, 0.05, SCAN_TIMING_ONE, 12.34},
        {0, 0, 0.05, SCAN_TIMING_ONE, 0},
        /* before time 0 as after it */
        {0.05, 0, 0.05, SCAN_TIMING_ONE, 0},
        {0.04, -0.02, 0.03, SCAN_TIMING_ONE, -0.04},
        {0.04, -0.01, 0.02, SCAN_TIMING_NONE, 0},
        {0.04, -0.2, 0.04, SCAN_TIMING_ONE, -0.2},
        {0.04, -999.99, 0.04, SCAN_TIMING_ONE, -1000},
        /* open at the start, closed at the end */
        {0.5, 1.0, 0.25, SCAN_TIMING_ONE, 1.0},
        {0.5, 1.25, 0.25, SCAN_TIMING_NONE, 0},
        {0.5, 1.125, 0.25, SCAN_TIMING_ONE, 1.0},
        {0.5, 1.0, 0.5, SCAN_TIMING_ONE, 1.0},
        {0.5, 1.0, 0.75, SCAN_TIMING_LONG_FRAME, 1.0},
        {0.5, 1.0, 0, SCAN_TIMING_NONE, 0},
        /* 1e-9 of a cycle counts as on it */
        {0.5, 1 - 0.4e-9, 0.25, SCAN_TIMING_ONE, 1.0},
        {0.5, 1 - 0.6e-9, 0.25, SCAN_TIMING_NONE, 0},
        {0.5, 1.25, 0.25 + 0.4e-9, SCAN_TIMING_NONE, 0},
        {0.5, 1.25, 0.25 + 0.6e-9, SCAN_TIMING_ONE, 1.0},
        /* frames that last longer than the cycle */
        {0.04, 0, 0.1, SCAN_TIMING_LONG_FRAME, 0},
        {0.04, 0.1, 0.1, SCAN_TIMING_LONG_FRAME, 0.1},
        {0.04, -0.21, 0.1, SCAN_TIMING_LONG_FRAME, -0.21},
        {0.001, 100, 0.1, SCAN_TIMING_LONG_FRAME, 100},
        {0.05, 0.05, 0.05 + 1e-9, SCAN_TIMING_LONG_FRAME, 0.05},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double instant_s = 0;
        assert_int_equal(scan_timing_instant_s(cases[i].cycle_s, cases[i].time_s,
                                               cases[i].interval_s, &instant_s),
                         cases[i].answer);
        assert_close(instant_s, cases[i].instant_s, 1e-9 * cases[i].cycle_s);
    }
}

TEST(instants_are_the_decimals_they_should_be)
{
    double instant_s = 0;
    /* 61 * 0.072 is 4.3919999999999995 in doubles. */
    assert_int_equal(scan_timing_instant_s(0.072, 4.4, 0.04, &instant_s), SCAN_TIMING_ONE);
    assert_true(instant_s == 4.392);
    /* On the frame's own time, the instant is that time: nothing then has to be moved. */
    assert_int_equal(scan_timing_instant_s(0.04, 7.0 / 25, 0.04, &instant_s), SCAN_TIMING_ONE);
    assert_true(instant_s == 7.0 / 25);
}

TEST(seconds_since_1970_lose_no_scan)
{
    int scans = 0;
    for (int i = 0; i < 2000; i++) {
        double instant_s;
        scans += scan_timing_instant_s(0.05, 1.7e9 + i / 20.0, 0.05, &instant_s) == SCAN_TIMING_ONE;
    }
    assert_int_equal(scans, 2000);
}

/* The instants before time 0 are those after it, mirrored. */
TEST(scans_before_time_0_are_as_many_as_after_it)
{
    int before = 0, after = 0;
    for (int i = 0; i < 30000; i++) {
        double instant_s;
        after += scan_timing_instant_s(0.072, i * 0.05 + 0.01, 0.05, &instant_s) == SCAN_TIMING_ONE;
        bool scan =
            scan_timing_instant_s(0.072, 0.04 - i * 0.05, 0.05, &instant_s) == SCAN_TIMING_ONE;
        before += scan;
        assert_true(!scan || (instant_s <= 0.04 - i * 0.05 && instant_s > -0.01 - i * 0.05));
    }
    assert_int_equal(before, after);
    assert_int_equal(before, 20833); /* up to 1499.96 s, and that at 0 */
}

/* Frames at i / rate, a cycle of ticks thousandths of a second: instant k belongs to the frame
 * i = ceil(k ticks rate / 1000), counted in whole numbers. */
TEST(every_instant_is_delivered_exactly_once)
{
    static const struct {
        int64_t rate_hz, ticks;
    } cases[] = {{20, 66}, {25, 40},  {20, 50},  {10, 100}, {30, 35},
                 {17, 60}, {20, 100}, {10, 700}, {50, 66},  {60, 50}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        double rate_hz = (double)cases[c].rate_hz;
        double cycle_s = (double)cases[c].ticks / 1000;
        int64_t next = 0;
        for (int64_t i = 0; i < 1000000; i++) {
            int64_t due = (next * cases[c].ticks * cases[c].rate_hz + 999) / 1000;
            double instant_s = -1;
            enum scan_timing_answer answer =
                scan_timing_instant_s(cycle_s, (double)i / rate_hz, 1 / rate_hz, &instant_s);
            assert_int_equal(answer, i == due ? SCAN_TIMING_ONE : SCAN_TIMING_NONE);
            if (answer != SCAN_TIMING_ONE)
                continue;
            assert_close(instant_s, (double)next * cycle_s, 1e-9 * cycle_s);
            next++;
        }
        assert_int_equal(next, INT64_C(999999000) / (cases[c].ticks * cases[c].rate_hz) + 1);
    }
}

TEST(frames_longer_than_the_cycle_have_a_scan_at_their_time)
{
    static const double rates_hz[] = {10, 20, 24.9};
    for (size_t rate = 0; rate < 3; rate++)
        for (int i = -1000; i < 1000; i++) {
            double time_s = i / rates_hz[rate], instant_s;
            assert_int_equal(scan_timing_instant_s(0.04, time_s, 1 / rates_hz[rate], &instant_s),
                             SCAN_TIMING_LONG_FRAME);
            assert_true(instant_s == time_s);
        }
}
