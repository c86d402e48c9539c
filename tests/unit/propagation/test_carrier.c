#include "check.h"

#include "propagation/carrier.h"
#include "sample.h"

#define LIGHT_MPS 299792458

/* Ten waves to a metre: 20 R turns. */
TEST(whole_turns_are_taken_off)
{
    static const double rows[][2] = {
        {0, 0},   {0.0125, 0.25},       {0.0375, -0.25},       {1, 0},
        {1e6, 0}, {100.003125, 0.0625}, {100.046875, -0.0625}, {123456.75, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_close(carrier_phase_turns(rows[i][0], 10.0 * LIGHT_MPS), rows[i][1], 1e-12);
    for (int i = 0; i < 40960; i++) {
        double off = carrier_phase_turns(i / 1024.0, 10.0 * LIGHT_MPS) - 20 * i / 1024.0;
        assert_close(off, round(off), 0);
    }
}

/* Ranges in 2^-16 m and carriers in Hz are integers, and so are the turns in parts of the speed of
 * light. */
TEST(turns_are_those_of_integer_arithmetic)
{
    const int64_t whole = (int64_t)LIGHT_MPS << 16;
    uint64_t sample = 39;
    for (int i = 0; i < 200000; i++) {
        int64_t range = (int64_t)(sample_bits(&sample) % (206 << 16));
        int64_t carrier = INT64_C(24000000000) + (int64_t)(sample_bits(&sample) % 57000000000);
        int64_t rest = 2 * range * carrier % whole;
        double turns = (double)(rest > whole / 2 ? rest - whole : rest) / (double)whole;
        double ours = carrier_phase_turns((double)range * 0x1p-16, (double)carrier);
        assert_true(fabs(ours) <= 0.5);
        assert_close(ours - turns - round(ours - turns), 0, 2e-16);
    }
}

/* A carrier higher by the speed of light adds 2 R turns. */
TEST(the_greatest_range_and_carrier_still_turn)
{
    for (int i = 0; i < 1000; i++) {
        double range_m = 1e6 - i * 0x1p-10;
        double turns = carrier_phase_turns(range_m, 1e12);
        double later = carrier_phase_turns(range_m, 1e12 + LIGHT_MPS);
        double expected = 2 * range_m;
        assert_close(later - turns - expected - round(later - turns - expected), 0, 3e-16);
    }
}
