#include "support/effect_bench.h"

/* Losses are twice those of one way. The documentation of snowpl in MATLAB's Radar Toolbox
 * (Gunn-East model) has 1.0017 dB over 10 km for 0.75 mm/h at 77 GHz. By hand, a wavelength of 1 cm
 * has 0.00349 + 0.00224 = 0.00573 dB/km in 1 mm/h, one of 2 cm 0.00349 10^1.6/16 + 0.0112 dB/km in
 * 10 mm/h. */
EFFECT_TEST(snow_attenuates_there_and_back)
{
    static const struct {
        double carrier_hz, snow_mmph, range_m, loss_db, slack_db;
    } cases[] = {
        {77e9, 0.75, 1e4, 2 * 1.0017, 1e-4},
        {29.9792458e9, 1, 1000, 2 * 0.00573, 1e-12},
        {14.9896229e9, 10, 1000, 2 * (0.00349 * 39.810717055349734 / 16 + 0.0112), 1e-12},
        {76.5e9, 0, 100, 0, 0},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct echo echo = effect_bench_echo(cases[i].range_m);
        bench->sensor.carrier_hz = cases[i].carrier_hz;
        bench->frame.conditions.snow_mmph = cases[i].snow_mmph;
        double factor = effect_bench_factor(bench, EFFECT_SNOW, &echo);
        assert_close(-20 * log10(factor), cases[i].loss_db, cases[i].slack_db);
    }
}
