#include "support/effect_bench.h"

/* ITU-R P.838-3 with vertical polarization, there and back: 2.190804 dB at 76.5 GHz and 0.614704 dB
 * at 24.125 GHz over 100 m in 25 mm/h, and 8.948216 dB at 76.5 GHz over 250 m in 50 mm/h. */
EFFECT_TEST(rain_attenuates_there_and_back)
{
    static const struct {
        double carrier_hz, rain_mmph, range_m, loss_db;
    } cases[] = {
        {76.5e9, 25, 100, 2.190804},
        {24.125e9, 25, 100, 0.614704},
        {76.5e9, 50, 250, 8.948216},
        {76.5e9, 0, 100, 0},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct echo echo = effect_bench_echo(cases[i].range_m);
        bench->sensor.carrier_hz = cases[i].carrier_hz;
        bench->frame.conditions.rain_mmph = cases[i].rain_mmph;
        double factor = effect_bench_factor(bench, EFFECT_RAIN, &echo);
        assert_close(-20 * log10(factor), cases[i].loss_db, 1e-6);
    }
}

EFFECT_TEST(rain_counts_by_polarization)
{
    struct echo echo = effect_bench_echo(100);
    bench->frame.conditions.rain_mmph = 25;
    bench->sensor.polarization = POLARIZATION_HORIZONTAL;
    double factor = effect_bench_factor(bench, EFFECT_RAIN, &echo);
    assert_close(-20 * log10(factor), 0.2 * 1.125295 * pow(25, 0.718767), 1e-5);
}
