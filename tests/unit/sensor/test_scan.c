#include "support/effect_bench.h"

#include "sensor/scan.h"

/* Adds an echo of this amplitude at any range. */
static void add_echo(struct effect_bench *bench, const char *sensor, const char *object,
                     double range_m, double range_rate_mps, double amplitude)
{
    struct echo *echo = list_add(&bench->frame.echoes, check_arena());
    *echo = effect_bench_echo(range_m);
    echo->sensor = sensor;
    echo->id.object = object;
    echo->range_rate_mps = range_rate_mps;
    echo->ercs = amplitude * range_m * range_m / 100;
}

static void check_cell(const struct scan *scan, size_t number, const char *names)
{
    size_t count;
    const struct received_echo *members = scan_members(scan, number, &count);
    assert_int_equal(count, strlen(names));
    for (size_t i = 0; i < count; i++)
        assert_int_equal(members[i].echo.id.object[0], names[i]);
}

static struct scan scan_as(struct effect_bench *bench, uint64_t effects, bool automatic)
{
    const struct selection selection = {
        .allowed = effects, .automatic = automatic, .log = &bench->log};
    struct effect_scan context =
        effect_begin(&bench->frame, &bench->sensor, &selection, EFFECT_HOME_SENSOR);
    bench->log = (struct effect_log){0};
    return scan_make(&context, &selection);
}

static struct scan scan_of(struct effect_bench *bench)
{
    return scan_as(bench, EVERY_EFFECT, false);
}

EFFECT_TEST(cells_are_numbered_by_their_leaders_strongest_first)
{
    add_echo(bench, "another", "z", 20, 0, 99);
    add_echo(bench, "radar", "a", 20.4, 0, 1);
    add_echo(bench, "radar", "b", 30, 0, 5);
    add_echo(bench, "radar", "c", 20, 0, 4);
    add_echo(bench, "radar", "d", 30, 0.6, 3);
    add_echo(bench, "radar", "e", 29.6, 0.4, 2);
    add_echo(bench, "radar", "f", 19.9, 0.5, 3.5);
    struct scan scan = scan_of(bench);
    assert_int_equal(scan.cells, 3);
    assert_int_equal(scan.silent_count, 0);
    check_cell(&scan, 0, "be");
    check_cell(&scan, 1, "cfa");
    check_cell(&scan, 2, "d");
    assert_true(bench->log.simulated == EFFECT_BIT(EFFECT_MERGING));
}

/* Echoes b and d have no cross section. */
EFFECT_TEST(echoes_without_amplitude_are_silent_and_in_no_cell)
{
    add_echo(bench, "radar", "a", 20, 0, 1);
    add_echo(bench, "radar", "b", 20, 0, 0);
    add_echo(bench, "radar", "c", 25, 0, 2);
    add_echo(bench, "radar", "d", 25, 0, 0);
    struct scan scan = scan_of(bench);
    assert_int_equal(scan.cells, 2);
    check_cell(&scan, 0, "c");
    check_cell(&scan, 1, "a");
    assert_int_equal(scan.silent_count, 2);
    assert_string_equal(scan.silent[0].echo.id.object, "b");
    assert_string_equal(scan.silent[1].echo.id.object, "d");
}

EFFECT_TEST(where_all_echoes_are_silent_there_is_no_cell)
{
    add_echo(bench, "radar", "a", 20, 0, 0);
    struct scan scan = scan_of(bench);
    assert_int_equal(scan.cells, 0);
    assert_int_equal(scan.silent_count, 1);
}

EFFECT_TEST(silent_echoes_are_lost_with_their_margins)
{
    bench->frame.sections = CARRY_ACCOUNT;
    add_echo(bench, "radar", "a", 20, 0, 1);
    add_echo(bench, "radar", "b", 20, 0, 0);
    margins_note(&bench->frame.echoes.items[1].margins, MARGIN_SIGHT, 0.25);
    struct scan scan = scan_of(bench);
    scan_account(&scan, &bench->frame, "sensor");
    assert_int_equal(bench->frame.lost.count, 1);
    const struct lost_group *group = bench->frame.lost.items;
    assert_string_equal(group->sensor, "radar");
    assert_string_equal(group->stage, "sensor");
    assert_int_equal(frame_loss_of(group->reason), LOSS_NO_AMPLITUDE);
    assert_int_equal(group->echoes.count, 1);
    assert_string_equal(group->echoes.items[0].id.object, "b");
    assert_int_equal(group->echoes.items[0].margins.present, MARGIN_SIGHT);
    assert_close(group->echoes.items[0].margins.sight_m, 0.25, 0);
}

EFFECT_TEST(a_scan_of_nothing_has_no_cells)
{
    struct scan scan = scan_of(bench);
    assert_int_equal(scan.cells, 0);
    assert_int_equal(scan.silent_count, 0);
}

EFFECT_TEST(auto_leaves_out_merging_where_no_echoes_are_close)
{
    add_echo(bench, "radar", "a", 20, 0, 1);
    add_echo(bench, "radar", "b", 20.6, 0, 2);
    struct scan scan = scan_as(bench, EVERY_EFFECT, true);
    assert_int_equal(scan.cells, 2);
    check_cell(&scan, 0, "b");
    check_cell(&scan, 1, "a");
    assert_true(bench->log.left_out == EFFECT_BIT(EFFECT_MERGING));
    assert_true(bench->log.simulated == 0);
    add_echo(bench, "radar", "c", 20.3, 0, 0.5);
    scan = scan_as(bench, EVERY_EFFECT, true);
    assert_int_equal(scan.cells, 2);
    check_cell(&scan, 0, "bc");
    assert_true(bench->log.simulated == EFFECT_BIT(EFFECT_MERGING));
    scan = scan_as(bench, EVERY_EFFECT & ~EFFECT_BIT(EFFECT_MERGING), true);
    assert_int_equal(scan.cells, 3);
}

/* Ranges fold at 15 m: a and b share a cell, unless folding is switched off. */
EFFECT_TEST(a_scan_has_only_the_effects_of_its_selection)
{
    bench->sensor.unambiguous_range_m = 15;
    add_echo(bench, "radar", "a", 20, 0, 1);
    add_echo(bench, "radar", "b", 5.25, 0, 2);
    struct scan scan = scan_of(bench);
    assert_int_equal(scan.cells, 1);
    check_cell(&scan, 0, "ba");
    scan = scan_as(bench, EVERY_EFFECT & ~EFFECT_BIT(EFFECT_AMBIGUITY), false);
    assert_int_equal(scan.cells, 2);
}

/* A window with cells of 1 m by 1 m/s resolves 1.7748 of them. b is so far from a as to have half
 * of its amplitude there; c is as far from a as the window resolves. */
EFFECT_TEST(echoes_of_a_window_part_by_phase_and_count_by_their_response)
{
    double resolution = point_response_resolution(POINT_RESPONSE_HANN);
    bench->sensor.waveform = (struct waveform){.samples = 128, .repetitions = 64};
    bench->sensor.cell_phase = CELL_PHASE_BY_PATH;
    suite_derive(&bench->sensor);
    add_echo(bench, "radar", "a", 20, 0, 4);
    add_echo(bench, "radar", "b", 20, resolution * 2 / 3.5802 * (1 - 1e-4), 2);
    size_t apart = 0;
    for (int i = 0; i < 40; i++) {
        bench->frame.echoes.items[0].range_m = 20 + 1e-4 * i;
        struct scan scan = scan_of(bench);
        size_t count;
        assert_int_equal(scan.cells, 1);
        const struct received_echo *members = scan_members(&scan, 0, &count);
        assert_near(members[0].amplitude, 4.0, 1e-3);
        assert_near(members[1].amplitude, 1.0, 1e-3);
        assert_near(members[1].strength, 1.0, 1e-3);
        bench->frame.echoes.items[1].range_rate_mps = resolution;
        apart += scan_of(bench).cells - 1;
        bench->frame.echoes.items[1].range_rate_mps = resolution * 2 / 3.5802 * (1 - 1e-4);
    }
    assert_in_range(apart, 10, 30);
    bench->frame.echoes.items[1].range_rate_mps = resolution;
    struct scan scan = scan_as(bench, EVERY_EFFECT & ~EFFECT_BIT(EFFECT_COHERENCE), false);
    check_cell(&scan, 0, "ab");
    assert_near(scan.by_cell[1].amplitude, 2.0, 1e-9);
}
