#include "support/effect_bench.h"

/* A wave travels there and back, so an eighth of a wavelength in range turns it by a quarter. */
EFFECT_TEST(a_phase_by_path_turns_with_range_and_stays_from_scan_to_scan)
{
    double wave_m = 299792458 / 76.5e9, uniform[4];
    bool labelled;
    bench->sensor.cell_phase = CELL_PHASE_BY_PATH;
    for (int eighths = 0; eighths < 16; eighths++) {
        struct echo echo = effect_bench_echo(50 + eighths * wave_m / 8);
        bench->frame.frame = 0;
        effect_bench_draw(bench, &echo, effect_coherence.purposes[1], 0, uniform);
        bench->frame.frame = eighths;
        struct effect_reception reception =
            effect_bench_receive(bench, EFFECT_COHERENCE, &echo, &labelled);
        double turns = uniform[0] - 2 * echo.range_m / wave_m;
        assert_close(remainder(reception.phase_rad / (2 * PI) - turns, 1), 0, 1e-10);
        assert_false(labelled);
        assert_true(reception.amplitude == 1 && reception.range_m == echo.range_m);
    }
}

EFFECT_TEST(a_random_phase_is_drawn_in_each_scan_and_not_by_range)
{
    bool labelled;
    double uniform[4];
    bench->sensor.cell_phase = CELL_RANDOM_PHASE;
    for (bench->frame.frame = 0; bench->frame.frame < 5; bench->frame.frame++)
        for (double range_m = 50; range_m < 50.01; range_m += 0.001) {
            struct echo echo = effect_bench_echo(range_m);
            effect_bench_draw(bench, &echo, effect_coherence.purposes[0], 0, uniform);
            struct effect_reception reception =
                effect_bench_receive(bench, EFFECT_COHERENCE, &echo, &labelled);
            assert_close(reception.phase_rad, 2 * PI * uniform[0], 0);
        }
}
