#include "check.h"

#include "radar/cfar.h"
#include "sample.h"

TEST(factors_are_those_of_the_published_formulas)
{
    static const struct {
        size_t cells, rank;
        double false_alarm, mean, ordered;
    } cases[] = {
        {16, 12, 1e-3, 8.638824, 7.421411},   {16, 12, 1e-4, 12.452471, 11.080194},
        {16, 12, 1e-6, 21.941979, 20.95416},  {24, 18, 1e-3, 8.004514, 6.502431},
        {24, 18, 1e-4, 11.227182, 9.340805},  {24, 18, 1e-6, 18.678706, 16.293288},
        {32, 24, 1e-3, 7.710008, 6.086337},   {32, 24, 1e-4, 10.672686, 8.580143},
        {32, 24, 1e-6, 17.277649, 14.398525},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        assert_near(cfar_factor(CFAR_MEAN, cases[i].cells, 1, cases[i].false_alarm), cases[i].mean,
                    1e-7);
        assert_near(cfar_factor(CFAR_ORDERED, cases[i].cells, cases[i].rank, cases[i].false_alarm),
                    cases[i].ordered, 1e-6);
    }
    assert_near(cfar_factor(CFAR_MEAN, 16, 1, 1e-12), 73.974612, 1e-8);
}

/* Rings of exponential noise; every cell is tested. */
static double measured(struct cfar cfar, double false_alarm)
{
    enum { RING = 64, RINGS = 4000 };
    uint64_t seed = 20;
    size_t alarms = 0;
    cfar.factor = cfar_factor(cfar.kind, cfar.cells, cfar.rank, false_alarm);
    for (size_t ring = 0; ring < RINGS; ring++) {
        double power[RING];
        for (size_t i = 0; i < RING; i++)
            power[i] = -log(sample_between(&seed, 0x1p-48, 1));
        for (size_t i = 0; i < RING; i++)
            alarms += power[i] >= cfar_threshold(&cfar, power, RING, 1, i);
    }
    return (double)alarms / (RING * RINGS);
}

/* 2560 alarms; neighbours share a window, so that errors are allowed twice theirs. */
TEST(noise_passes_as_often_as_the_closed_form_says)
{
    assert_near(measured((struct cfar){CFAR_MEAN, 16, 3, 1, 0, 0}, 1e-2), 1e-2, 0.06);
    assert_near(measured((struct cfar){CFAR_ORDERED, 16, 3, 1, 12, 0}, 1e-2), 1e-2, 0.06);
    assert_near(measured((struct cfar){CFAR_MEAN, 32, 1, 1, 0, 0}, 1e-3), 1e-3, 0.2);
}

TEST(guards_and_the_cell_itself_do_not_count_and_the_ring_is_closed)
{
    double power[2 * 9] = {0};
    struct cfar cfar = {CFAR_MEAN, 4, 3, 1, 0, 1};
    for (size_t i = 0; i < 9; i++)
        power[2 * i] = 1;
    power[0] = power[2] = power[4] = power[2 * 7] = power[2 * 8] = 100;
    assert_close(cfar_threshold(&cfar, power, 9, 2, 0), 1, 0);
    power[2 * 3] = 5;
    assert_close(cfar_threshold(&cfar, power, 9, 2, 0), 2, 0);
}

TEST(a_window_takes_cells_as_far_apart_as_its_spacing_says)
{
    double power[15] = {0};
    struct cfar cfar = {CFAR_MEAN, 4, 2, 3, 0, 1};
    power[7 - 2] = power[7 + 2] = power[7 - 5] = power[7 + 5] = 1;
    assert_int_equal(cfar_extent(&cfar), 11);
    assert_close(cfar_threshold(&cfar, power, 15, 1, 7), 1, 0);
}

TEST(a_strong_neighbour_raises_the_mean_and_not_the_rank)
{
    double power[40];
    struct cfar mean = {CFAR_MEAN, 16, 3, 1, 12, 1}, ordered = {CFAR_ORDERED, 16, 3, 1, 12, 1};
    for (size_t i = 0; i < COUNT(power); i++)
        power[i] = 1;
    for (size_t i = 0; i < 4; i++)
        power[24 + i] = 101;
    /* MODEL 11.4: 1 + chi_s/N for each of them */
    assert_near(cfar_threshold(&mean, power, COUNT(power), 1, 20), 1 + 4 * 100. / 16, 1e-15);
    assert_close(cfar_threshold(&ordered, power, COUNT(power), 1, 20), 1, 0);
}
