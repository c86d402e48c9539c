#include "support/effect_bench.h"

/* ITU-R P.840 at 10 deg C: 3.115457 dB/km per g/m^3 one way at 76.5 GHz. */
static void fog_takes_its_decibels_there_and_back(void **state)
{
    struct effect_bench *bench = *state;
    static const double water_gpm3[] = {0.5, 0.05, 0};
    for (size_t i = 0; i < COUNT(water_gpm3); i++) {
        struct echo echo = effect_bench_echo(100);
        bench->frame.conditions.fog_gpm3 = water_gpm3[i];
        double factor = effect_bench_factor(bench, EFFECT_FOG, &echo);
        assert_close(-20 * log10(factor), 0.2 * 3.115457 * water_gpm3[i], 1e-6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        EFFECT_TEST(fog_takes_its_decibels_there_and_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
