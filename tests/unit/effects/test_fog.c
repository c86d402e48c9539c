#include "support/effect_bench.h"

/* ITU-R P.840 has 3.115457 dB/km one way per g/m^3 at 76.5 GHz and 10 degrees Celsius. */
EFFECT_TEST(fog_attenuates_there_and_back)
{
    static const double water_gpm3[] = {0.5, 0.05, 0};
    for (size_t i = 0; i < COUNT(water_gpm3); i++) {
        struct echo echo = effect_bench_echo(100);
        bench->frame.conditions.fog_gpm3 = water_gpm3[i];
        double factor = effect_bench_factor(bench, EFFECT_FOG, &echo);
        assert_close(-20 * log10(factor), 0.2 * 3.115457 * water_gpm3[i], 1e-6);
    }
}
