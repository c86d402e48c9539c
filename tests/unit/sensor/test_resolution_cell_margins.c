#include "check.h"

#include "noise/target_list.h"

#include "radar/resolution.h"
#include "sample.h"
#include "sensor/resolution_cell.h"

enum { ALL = 4 };

/* A sensor with a threshold of 2 and cells that reach 1 m and 2 m/s to either side. */
static const struct sensor sensor = {.name = "s",
                                     .threshold = 2,
                                     .lowered_threshold = 2,
                                     .half_range_m = 1,
                                     .half_range_rate_mps = 2};

static const struct resolution resolution = {1, 2, false};

struct given_echo {
    double range_m, range_rate_mps, amplitude, sight_m;
};

/* Clusters echoes, strongest first, and works out the margins of every cell; returns how many. */
static size_t margins_of(const struct given_echo *given, size_t count, struct margins *margins)
{
    struct received_echo echoes[ALL];
    struct margins sight_margins[ALL] = {{0}};
    struct resolution_echo to_cluster[ALL];
    size_t cell[ALL];
    for (size_t i = 0; i < count; i++) {
        margins_note(&sight_margins[i], MARGIN_SIGHT, given[i].sight_m);
        echoes[i] = (struct received_echo){.range_m = given[i].range_m,
                                           .range_rate_mps = given[i].range_rate_mps,
                                           .amplitude = given[i].amplitude,
                                           .margins = &sight_margins[i]};
        to_cluster[i] = (struct resolution_echo){given[i].range_m, given[i].range_rate_mps,
                                                 given[i].amplitude, 0, 0};
    }
    size_t cells = resolution_cluster(to_cluster, count, &resolution, cell, check_arena());
    const struct clustered_echoes all = {echoes, cell, count, resolution};
    memcpy(margins, resolution_cell_margins(&sensor, &all, cells, check_arena()),
           cells * sizeof *margins);
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

TEST(a_cell_has_the_least_margins_of_its_pairs)
{
    const double ten_to_8 = 20 * log10(10 / 8.0), ten_to_5 = 20 * log10(2.0);
    const struct {
        const char *what;
        struct given_echo given[ALL];
        size_t count, cells;
        struct {
            double sight_m, leader_db, cell_edge;
        } margins[ALL];
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
        {"the third one, between the first two, is in the first one's cell",
         {{10, 0, 10, 3}, {11.5, 0, 8, 2}, {10.75, 0, 5, 1}},
         3,
         2,
         {{1, ten_to_8, 0.25}, {2, ten_to_8, 0.5}}},
        {"a member of the second cell that is near the first one's edge",
         {{10, 0, 10, 3}, {11.5, 0, 8, 2}, {11.125, 0, 5, 1}},
         3,
         2,
         {{3, ten_to_8, 0.125}, {1, ten_to_8, 0.125}}},
        {"a tie on an edge", {{10, 0, 10, 3}, {11, 0, 10, 0}}, 2, 1, {{0, 0, 0}}},
        {"the second and the third compete for the lead, too",
         {{10, 0, 10, 3}, {12.5, 0, 8, 2}, {11.25, 0, 5, 1}},
         3,
         3,
         {{3, ten_to_5, 0.25}, {2, 20 * log10(1.6), 0.25}, {1, 20 * log10(1.6), 0.25}}},
        {"the third one is far away and alone",
         {{10, 0, 10, 3}, {10.5, 0, 8, 2}, {50, 0, 5, 1}},
         3,
         2,
         {{2, ten_to_8, 0.5}, {1, none, 39}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct margins margins[ALL];
        print_message("%s\n", cases[i].what);
        assert_int_equal(margins_of(cases[i].given, cases[i].count, margins), cases[i].cells);
        for (size_t j = 0; j < cases[i].cells; j++) {
            const struct margins *cell_margins = &margins[j];
            assert_margin(cell_margins, MARGIN_SIGHT, cell_margins->sight_m,
                          cases[i].margins[j].sight_m);
            assert_margin(cell_margins, MARGIN_LEADER, cell_margins->leader_db,
                          cases[i].margins[j].leader_db);
            assert_margin(cell_margins, MARGIN_CELL_EDGE, cell_margins->cell_edge,
                          cases[i].margins[j].cell_edge);
        }
    }
}

/* By how many half cells b is beyond the edge of a's cell. */
static double beyond(const struct received_echo *a, const struct received_echo *b)
{
    double size = 1 + fmax(a->widening, b->widening);
    return fmax(fabs(a->range_m - b->range_m) / size,
                fabs(a->range_rate_mps - b->range_rate_mps) / (2 * size)) -
           1;
}

/* The margins of one cell from all pairs, as the header defines them. */
static struct margins margins_from_all_pairs(const struct clustered_echoes *all, size_t number)
{
    struct margins margins = {0};
    size_t opened = 0;
    for (size_t i = 0; i < all->count; i++) {
        if (all->cell[i] != opened)
            continue;
        opened++;
        for (size_t j = i + 1; j < all->count; j++) {
            bool left = all->cell[j] >= all->cell[i];
            if (!left || (all->cell[i] != number && all->cell[j] != number))
                continue;
            double edge = beyond(&all->echoes[i], &all->echoes[j]);
            margins_note(&margins, MARGIN_CELL_EDGE, fabs(edge));
            if (edge <= 1)
                margins_note(&margins, MARGIN_LEADER,
                             20 * log10(all->echoes[i].amplitude / all->echoes[j].amplitude));
        }
    }
    return margins;
}

/* Echoes along range, along range rate, in a crowd and few, some with larger cells than others. */
TEST(margins_are_those_of_all_pairs)
{
    enum { ECHOES = 60 };
    static const struct margins no_margins = {0};
    uint64_t random = 5;
    for (int round = 0; round < 400; round++) {
        struct received_echo echoes[ECHOES];
        struct resolution_echo places[ECHOES];
        size_t cell[ECHOES], count = 1 + sample_bits(&random) % ECHOES;
        double range_m = pow(10, sample_between(&random, -1, 3));
        double rate_mps = pow(10, sample_between(&random, -1, 3));
        for (size_t i = 0; i < count; i++) {
            echoes[i] =
                (struct received_echo){.range_m = sample_between(&random, 0, range_m),
                                       .range_rate_mps = sample_between(&random, 0, rate_mps),
                                       .amplitude = (double)(ECHOES - i),
                                       .widening = i % 7 == 0 ? sample_between(&random, 0, 2) : 0,
                                       .margins = &no_margins};
            places[i] = resolution_cell_place(&echoes[i]);
        }
        size_t cells = resolution_cluster(places, count, &resolution, cell, check_arena());
        const struct clustered_echoes all = {echoes, cell, count, resolution};
        const struct margins *margins =
            resolution_cell_margins(&sensor, &all, cells, check_arena());
        for (size_t i = 0; i < cells; i++) {
            struct margins expected = margins_from_all_pairs(&all, i);
            assert_int_equal(margins[i].present, expected.present);
            assert_close(margins[i].cell_edge, expected.cell_edge, 1e-9);
            assert_close(margins[i].leader_db, expected.leader_db, 1e-9);
        }
    }
}

/* One of the cells reaches 2 m, of which 1.5 m are a quarter from the edge. */
TEST(the_edge_is_that_of_the_larger_cell)
{
    for (size_t wide = 0; wide < 2; wide++) {
        const struct margins none_of_sight = {0};
        struct received_echo echoes[] = {
            {.range_m = 10, .amplitude = 10, .margins = &none_of_sight},
            {.range_m = 11.5, .amplitude = 5, .margins = &none_of_sight}};
        const size_t cell[] = {0, 0};
        echoes[wide].widening = 1;
        const struct clustered_echoes all = {echoes, cell, 2, resolution};
        assert_close(resolution_cell_margins(&sensor, &all, 1, check_arena())->cell_edge, 0.25,
                     1e-13);
    }
}

/* With delta 3 - 4j and sum 2, Im(delta conj sum) is -8 and |delta| |sum| is 10. */
TEST(a_cell_has_margins_of_threshold_and_sign)
{
    struct cell cell = {.amplitude = 20, .sum_re = 2, .delta_re = 3, .delta_im = -4};
    resolution_cell_note_margins(&sensor, &cell);
    assert_int_equal(cell.margins.present, MARGIN_THRESHOLD | MARGIN_SIGN);
    assert_close(cell.margins.threshold_db, 20, 1e-13);
    assert_close(cell.margins.sign, 0.8, 1e-15);
    /* The ratio rule decides no sign, and without a delta there is none to decide. */
    struct sensor ratio = sensor;
    ratio.angle_estimator = MONOPULSE_RATIO;
    cell.margins.present = 0;
    resolution_cell_note_margins(&ratio, &cell);
    assert_int_equal(cell.margins.present, MARGIN_THRESHOLD);
    cell = (struct cell){.amplitude = 0.2, .sum_re = 2};
    resolution_cell_note_margins(&sensor, &cell);
    assert_int_equal(cell.margins.present, MARGIN_THRESHOLD);
    assert_close(cell.margins.threshold_db, 20, 1e-13);
}

TEST(the_noisy_cell_has_the_lesser_margins)
{
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
