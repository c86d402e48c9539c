#include "check.h"

#include "noise/target_list.h"

#include "radar/resolution.h"
#include "sensor/cell_margins.h"

enum { ALL = 4 };

/* A threshold of 2 and cells of 1 m by 2 m/s to either side. */
static const struct sensor sensor = {
    .name = "s", .threshold = 2, .half_range_m = 1, .half_range_rate_mps = 2};

struct spot {
    double range_m, range_rate_mps, amplitude, sight_m;
};

/* The margins of each cell that the spots, strongest first, form. */
static size_t margins_of(const struct spot *spots, size_t count, struct margins *answers)
{
    struct received_echo received_echoes[ALL];
    struct margins sights[ALL] = {{0}};
    struct resolution_echo echoes[ALL];
    size_t cell[ALL];
    for (size_t i = 0; i < count; i++) {
        margins_note(&sights[i], MARGIN_SIGHT, spots[i].sight_m);
        received_echoes[i] = (struct received_echo){.range_m = spots[i].range_m,
                                                    .range_rate_mps = spots[i].range_rate_mps,
                                                    .amplitude = spots[i].amplitude,
                                                    .margins = &sights[i]};
        echoes[i] =
            (struct resolution_echo){spots[i].range_m, spots[i].range_rate_mps, spots[i].amplitude};
    }
    struct arena arena = {0};
    size_t cells = resolution_cluster(echoes, count, sensor.half_range_m,
                                      sensor.half_range_rate_mps, cell, &arena);
    arena_free(&arena);
    const struct clustered_echoes all = {received_echoes, cell, count};
    for (size_t number = 0; number < cells; number++)
        answers[number] = cell_margins_of(&sensor, &all, number);
    return cells;
}

static void assert_margin(const struct margins *margins, enum margin which, double actual,
                          double expected)
{
    assert_int_equal((margins->present & which) != 0, isfinite(expected));
    if (isfinite(expected))
        assert_close(actual, expected, 1e-13);
}

static const double none = (double)INFINITY;

static void cells_tell_how_near_their_decisions_were(void **state)
{
    (void)state;
    const double ten_to_8 = 20 * log10(10 / 8.0), ten_to_5 = 20 * log10(2.0);
    const struct {
        const char *what;
        struct spot spots[ALL];
        size_t count, cells;
        struct {
            double sight_m, leader_db, cell_edge;
        } answers[ALL];
    } cases[] = {
        {"one alone", {{10, 0, 10, 3}}, 1, 1, {{3, none, none}}},
        {"two share, nearer the edge in range",
         {{10, 0, 10, 3}, {10.75, 1, 8, 2}},
         2,
         1,
         {{2, ten_to_8, 0.25}}},
        {"two share, nearer the edge in rate",
         {{10, 0, 10, 3}, {10.25, 1.5, 8, 4}},
         2,
         1,
         {{3, ten_to_8, 0.25}}},
        {"two apart, the farther edge counts",
         {{10, 0, 10, 3}, {11.5, 2.5, 8, 2}},
         2,
         2,
         {{3, ten_to_8, 0.5}, {2, ten_to_8, 0.5}}},
        {"two too far apart to compete",
         {{10, 0, 10, 3}, {12.5, 0, 8, 2}},
         2,
         2,
         {{3, none, 1.5}, {2, none, 1.5}}},
        {"between the first two: the third is the first one's",
         {{10, 0, 10, 3}, {11.5, 0, 8, 2}, {10.75, 0, 5, 1}},
         3,
         2,
         {{1, ten_to_8, 0.25}, {2, ten_to_8, 0.5}}},
        {"a member of the second, seen from the first as well",
         {{10, 0, 10, 3}, {11.5, 0, 8, 2}, {11.125, 0, 5, 1}},
         3,
         2,
         {{3, ten_to_8, 0.125}, {1, ten_to_8, 0.125}}},
        {"a tie on an edge", {{10, 0, 10, 3}, {11, 0, 10, 0}}, 2, 1, {{0, 0, 0}}},
        {"the stronger of two others is the nearer to lead",
         {{10, 0, 10, 3}, {12.5, 0, 8, 2}, {11.25, 0, 5, 1}},
         3,
         3,
         {{3, ten_to_5, 0.25}, {2, 20 * log10(1.6), 0.25}, {1, 20 * log10(1.6), 0.25}}},
        {"no business of the third, which is far off",
         {{10, 0, 10, 3}, {10.5, 0, 8, 2}, {50, 0, 5, 1}},
         3,
         2,
         {{2, ten_to_8, 0.5}, {1, none, 39}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct margins answers[ALL];
        print_message("%s\n", cases[i].what);
        assert_int_equal(margins_of(cases[i].spots, cases[i].count, answers), cases[i].cells);
        for (size_t j = 0; j < cases[i].cells; j++) {
            const struct margins *one = &answers[j];
            assert_margin(one, MARGIN_SIGHT, one->sight_m, cases[i].answers[j].sight_m);
            assert_margin(one, MARGIN_LEADER, one->leader_db, cases[i].answers[j].leader_db);
            assert_margin(one, MARGIN_CELL_EDGE, one->cell_edge, cases[i].answers[j].cell_edge);
        }
    }
}

/* Delta 3 - 4j under a sum of 2: Im(delta conj sum) is -8 of 10. */
static void a_cell_tells_threshold_and_sign(void **state)
{
    (void)state;
    struct cell cell = {.amplitude = 20, .sum_re = 2, .delta_re = 3, .delta_im = -4};
    cell_margins_add(&sensor, &cell);
    assert_int_equal(cell.margins.present, MARGIN_THRESHOLD | MARGIN_SIGN);
    assert_close(cell.margins.threshold_db, 20, 1e-13);
    assert_close(cell.margins.sign, 0.8, 1e-15);
    /* The ratio decides no sign, and there is none without a delta. */
    struct sensor ratio = sensor;
    ratio.angle_estimator = MONOPULSE_RATIO;
    cell.margins.present = 0;
    cell_margins_add(&ratio, &cell);
    assert_int_equal(cell.margins.present, MARGIN_THRESHOLD);
    cell = (struct cell){.amplitude = 0.2, .sum_re = 2};
    cell_margins_add(&sensor, &cell);
    assert_int_equal(cell.margins.present, MARGIN_THRESHOLD);
    assert_close(cell.margins.threshold_db, 20, 1e-13);
}

static void noise_tells_its_own_if_it_is_less(void **state)
{
    (void)state;
    struct margins margins = {
        .threshold_db = 10, .sign = 0.5, .present = MARGIN_THRESHOLD | MARGIN_SIGN};
    const struct cell cell = {0};
    struct antenna_pointers pointers = {.sum = 1, .delta = 0.1 * (double _Complex)I + 0.4};
    target_list_note_margins(&sensor, &cell, pointers, 2, sensor.final_threshold, &margins);
    assert_close(margins.threshold_db, 10, 0);
    assert_close(margins.sign, 0.1 / sqrt(0.17), 1e-15);
    struct sensor final = sensor;
    final.final_threshold = true;
    target_list_note_margins(&final, &cell, pointers, 200, final.final_threshold, &margins);
    assert_close(margins.threshold_db, 10, 0);
    target_list_note_margins(&final, &cell, pointers, 2, final.final_threshold, &margins);
    assert_close(margins.threshold_db, 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_tell_how_near_their_decisions_were),
        cmocka_unit_test(a_cell_tells_threshold_and_sign),
        cmocka_unit_test(noise_tells_its_own_if_it_is_less),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
