#include "support/effect_bench.h"

/* A dwell of 50 ms and cells of 0.5 m: 40 m/s walk 4 cells, where the integral of MODEL 14.20 is
 * down by 2.503 dB with Hann's window and by 11.037 dB without. */
static void set_radar(struct effect_bench *bench, enum range_migration migration)
{
    bench->sensor.range_migration = migration;
    bench->sensor.cell_range_m = 0.5;
    bench->sensor.cell_range_rate_mps = units_wavelength_m(76.5e9) / 2 / 0.05;
}

static struct echo walking_echo(struct effect_bench *bench, double range_rate_mps)
{
    struct echo echo = effect_bench_echo(100);
    echo.range_rate_mps = range_rate_mps;
    *list_add(&bench->frame.echoes, check_arena()) = echo;
    return echo;
}

EFFECT_TEST(echoes_that_walk_fade_and_widen_in_either_direction)
{
    static const struct {
        enum range_migration migration;
        double loss_db, width_cells, width_at_rest;
    } cases[] = {{MIGRATION_HANN, 2.503, 2.578, 2}, {MIGRATION_RECTANGULAR, 11.037, 3.85, 1.2067}};
    for (size_t i = 0; i < COUNT(cases); i++)
        for (double rate_mps = -40; rate_mps <= 40; rate_mps += 80) {
            bool labelled;
            struct echo echo = walking_echo(bench, rate_mps);
            set_radar(bench, cases[i].migration);
            struct effect_reception reception =
                effect_bench_receive(bench, EFFECT_RANGE_MIGRATION, &echo, &labelled);
            assert_true(labelled && reception.strength == reception.amplitude);
            assert_close(-20 * log10(reception.amplitude), cases[i].loss_db, 0.3);
            assert_close(cases[i].width_at_rest * (1 + reception.widening), cases[i].width_cells,
                         0.15);
        }
}

EFFECT_TEST(a_cell_of_which_half_is_told_walks_as_the_whole_one)
{
    bool labelled;
    struct echo echo = walking_echo(bench, 30);
    set_radar(bench, MIGRATION_HANN);
    struct effect_reception whole =
        effect_bench_receive(bench, EFFECT_RANGE_MIGRATION, &echo, &labelled);
    bench->sensor.cell_extent = CELL_HALF_WIDTH;
    bench->sensor.cell_range_m /= 2;
    bench->sensor.cell_range_rate_mps /= 2;
    struct effect_reception half =
        effect_bench_receive(bench, EFFECT_RANGE_MIGRATION, &echo, &labelled);
    assert_close(half.amplitude, whole.amplitude, 1e-15);
    assert_close(half.widening, whole.widening, 1e-15);
}

static bool is_simulated(struct effect_bench *bench, enum range_migration migration,
                         uint64_t effects)
{
    set_radar(bench, migration);
    struct effect_scan scan = effect_bench_begin(bench, effects, EFFECT_HOME_SENSOR);
    return effect_simulates(&scan, EFFECT_RANGE_MIGRATION);
}

EFFECT_TEST(it_is_simulated_only_if_the_radar_has_a_window_and_an_echo_walks)
{
    uint64_t alone = EFFECT_BIT(EFFECT_RANGE_MIGRATION);
    walking_echo(bench, 0);
    assert_false(is_simulated(bench, MIGRATION_HANN, alone));
    walking_echo(bench, 1e-3);
    assert_true(is_simulated(bench, MIGRATION_HANN, alone));
    assert_true(is_simulated(bench, MIGRATION_RECTANGULAR, alone));
    assert_false(is_simulated(bench, MIGRATION_NONE, alone));
    assert_false(is_simulated(bench, MIGRATION_COMPENSATED, alone));
    assert_false(is_simulated(bench, MIGRATION_HANN, 0));
}

/* The radar drives, so that the ground walks; ideal has no echo. */
EFFECT_TEST(echoes_that_other_effects_add_may_walk)
{
    bench->frame.conditions.clutter_per_m2 = 0.01;
    bench->frame.conditions.clutter_ercs = 0.1;
    assert_true(is_simulated(bench, MIGRATION_HANN, EVERY_EFFECT));
    assert_false(is_simulated(bench, MIGRATION_HANN, EFFECT_BIT(EFFECT_RANGE_MIGRATION)));
}
