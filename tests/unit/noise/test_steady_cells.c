#include "check.h"

#include "base/units.h"
#include "noise/steady_cells.h"
#include "sensor/resolution_cell.h"

/* A sensor with a threshold of 2, lowered to 0.25 by noise of 1. */
static const struct sensor radar = {.name = "s", .threshold = 2, .lowered_threshold = 0.25};

struct bench {
    struct frame frame;
    struct sensor sensor;
    struct effect_scan scan;
};

/* The sensor lists a cell of this amplitude, and of one echo, in a frame with margins. */
static void list(struct bench *bench, double amplitude, uint64_t effects)
{
    const struct selection selection = {.allowed = effects};
    struct cell cell = {.sensor = "s", .amplitude = amplitude, .sum_re = amplitude};
    *list_add(&cell.members, check_arena()) =
        (struct contributor){.id.object = "a", .id.reflector = "r", .weight = 1};
    bench->scan.sensor = &bench->sensor;
    resolution_cell_list(&bench->frame, "sensor", &bench->scan, &selection, &cell, true);
}

static struct bench make(void)
{
    return (struct bench){
        .frame = {.arena = check_arena(), .sections = CARRY_ACCOUNT | CARRY_MARGINS},
        .sensor = radar};
}

static const struct lost_group *only_loss(const struct bench *bench)
{
    assert_int_equal(bench->frame.lost.count, 1);
    assert_int_equal(bench->frame.lost.items[0].echoes.count, 1);
    return &bench->frame.lost.items[0];
}

TEST(cells_that_noise_can_lift_over_the_threshold_pass_the_lowered_one)
{
    struct bench bench = make();
    list(&bench, 2, ~0U);
    list(&bench, 1.9, ~0U);
    list(&bench, 0.25, ~0U);
    assert_int_equal(bench.frame.cells.count, 3);
    const struct cell *cells = bench.frame.cells.items;
    assert_true(!cells[0].below_threshold && cells[1].below_threshold && cells[2].below_threshold);
    assert_close(cells[0].margins.threshold_db, units_amplitude_db(8), 1e-12);
    list(&bench, 0.2, ~0U);
    assert_int_equal(bench.frame.cells.count, 3);
    const struct lost_echo *lost = only_loss(&bench)->echoes.items;
    assert_close(lost->shortfall_db, 20, 1e-12);
    assert_close(lost->margins.threshold_db, units_amplitude_db(1.25), 1e-12);
}

TEST(the_lowered_threshold_rises_with_interference)
{
    struct bench bench = make();
    bench.scan.interference = 3;
    list(&bench, 0.5, ~0U);
    list(&bench, 0.49, ~0U);
    assert_int_equal(bench.frame.cells.count, 1);
}

TEST(a_lowered_threshold_of_nothing_loses_no_cell_and_has_no_margin)
{
    struct bench bench = make();
    bench.sensor.lowered_threshold = 0;
    list(&bench, 1e-9, ~0U);
    assert_int_equal(bench.frame.cells.count, 1);
    assert_int_equal(bench.frame.cells.items[0].margins.present & MARGIN_THRESHOLD, 0);
}

TEST(cells_below_the_threshold_are_lost_where_no_noise_is_tested)
{
    struct bench bench = make();
    list(&bench, 2, ~0U);
    list(&bench, 1.4, ~0U);
    struct cell_span steady = steady_cells_of(&bench.frame, "noise-none", &bench.sensor);
    assert_int_equal(steady.count, 1);
    assert_close(steady.items[0].margins.threshold_db, 0, 1e-12);
    const struct lost_group *group = only_loss(&bench);
    assert_string_equal(group->stage, "noise-none");
    assert_string_equal(group->reason, "below_threshold");
    assert_close(group->echoes.items[0].shortfall_db, units_amplitude_db(2 / 1.4), 1e-12);
}

/* Without the effect threshold, or in a sensor's stead, cells are of any amplitude. */
TEST(cells_that_no_threshold_tested_stay)
{
    struct bench bench = make();
    list(&bench, 0.1, 0);
    *list_add(&bench.frame.cells, check_arena()) = (struct cell){.sensor = "s", .amplitude = 0.1};
    struct cell_span steady = steady_cells_of(&bench.frame, "noise", &bench.sensor);
    assert_int_equal(steady.count, 2);
    assert_int_equal(bench.frame.lost.count, 0);
}

TEST(the_threshold_is_lowered_where_a_final_one_and_noise_follow)
{
    struct sensor sensor = {.carrier_hz = 77e9,
                            .cell_range_m = 1,
                            .cell_range_rate_mps = 1,
                            .threshold_db = 20,
                            .pointer_sigma = 2,
                            .final_threshold = true};
    suite_derive(&sensor);
    assert_close(sensor.lowered_threshold, 6.5, 1e-12);
    sensor.first_threshold = FIRST_FULL;
    suite_derive(&sensor);
    assert_close(sensor.lowered_threshold, 10, 1e-12);
    sensor.first_threshold = FIRST_LOWERED;
    sensor.final_threshold = false;
    suite_derive(&sensor);
    assert_close(sensor.lowered_threshold, 10, 1e-12);
}
