#include "check.h"

#include "base/random.h"
#include "base/units.h"
#include "radar/resolution.h"

#define ECHO_MAX 16

/* The frame's total order, as far as an echo here has members. */
static int compare_echoes(const void *first, const void *second)
{
    const struct resolution_echo *a = first;
    const struct resolution_echo *b = second;
    if (a->amplitude < b->amplitude || a->amplitude > b->amplitude)
        return a->amplitude < b->amplitude ? 1 : -1;
    if (a->range_m < b->range_m || a->range_m > b->range_m)
        return a->range_m > b->range_m ? 1 : -1;
    return (a->range_rate_mps > b->range_rate_mps) - (a->range_rate_mps < b->range_rate_mps);
}

static size_t cluster(const struct resolution_echo *echoes, size_t count, double half_range_m,
                      double half_range_rate_mps, size_t *cell)
{
    const struct resolution resolution = {half_range_m, half_range_rate_mps, false};
    size_t cells = resolution_cluster(echoes, count, &resolution, cell, check_arena());
    return cells;
}

static double draw(uint64_t scene, uint32_t index)
{
    struct random_address address = {.seed = 11, .scene = scene};
    double uniform[4];
    random_uniform(&address, RANDOM_OWN, index, uniform);
    return uniform[0];
}

/* Coarse steps, so that many amplitudes tie and many distances lie on a border. */
static size_t draw_echoes(uint64_t scene, struct resolution_echo *echoes)
{
    size_t count = (size_t)(draw(scene, 0) * ECHO_MAX) + 1;
    for (uint32_t i = 0; i < count; i++)
        echoes[i] =
            (struct resolution_echo){.range_m = 10 + 0.05 * floor(20 * draw(scene, 3 * i + 1)),
                                     .range_rate_mps = 0.125 * floor(8 * draw(scene, 3 * i + 2)),
                                     .amplitude = 1 + floor(4 * draw(scene, 3 * i + 3))};
    qsort(echoes, count, sizeof *echoes, compare_echoes);
    return count;
}

/* MODEL 13. */
TEST(the_four_echoes_of_the_model_make_three_cells)
{
    static const struct resolution_echo echoes[] = {{10.00, -2.0, 10, 0, 0},
                                                    {10.10, -2.1, 5, 0, 0},
                                                    {10.40, -2.0, 4, 0, 0},
                                                    {10.12, -1.5, 3, 0, 0}};
    static const size_t expected[] = {0, 0, 1, 2};
    size_t cell[4];
    assert_int_equal(cluster(echoes, 4, 0.15, 0.25, cell), 3);
    assert_memory_equal(cell, expected, sizeof cell);
    double range_m = resolution_mean((double[]){10.00, 10.10}, (double[]){10, 5}, 2);
    double range_rate_mps = resolution_mean((double[]){-2.0, -2.1}, (double[]){10, 5}, 2);
    assert_near(range_m, 10 + 0.1 / 3, 1e-15);
    assert_near(range_rate_mps, -2 - 0.1 / 3, 1e-15);
}

TEST(no_echo_makes_no_cell)
{
    assert_int_equal(cluster(NULL, 0, 0.15, 0.25, NULL), 0);
}

/* Hard case 44: three distances of 0.15 m as written. */
TEST(the_border_is_decided_by_the_doubles)
{
    static const struct {
        double leader_m, echo_m;
        size_t cells;
    } cases[] = {{12.55, 12.40, 2}, {12.70, 12.55, 1}, {0.45, 0.30, 2}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct resolution_echo echoes[] = {{cases[i].leader_m, 0, 2, 0, 0},
                                           {cases[i].echo_m, 0, 1, 0, 0}};
        size_t cell[2];
        assert_int_equal(cluster(echoes, 2, 0.15, 0.25, cell), cases[i].cells);
    }
    static const struct resolution_echo exact[] = {{8, 1, 5, 0, 0},
                                                   {8, 1.25, 4, 0, 0},
                                                   {8, 0.75, 3, 0, 0},
                                                   {8.125, 1, 2, 0, 0},
                                                   {7.875, 1, 1, 0, 0}};
    size_t cell[5];
    assert_int_equal(cluster(exact, 5, 0.125, 0.25, cell), 1);
}

TEST(a_cell_does_not_grow_along_a_chain)
{
    static const struct resolution_echo echoes[] = {
        {10.0, 0, 5, 0, 0}, {10.1, 0, 4, 0, 0}, {10.2, 0, 3, 0, 0}, {10.3, 0, 2, 0, 0}};
    static const size_t expected[] = {0, 0, 1, 1};
    size_t cell[4];
    assert_int_equal(cluster(echoes, 4, 0.15, 0.25, cell), 2);
    assert_memory_equal(cell, expected, sizeof cell);
}

/* On a grid of half cells, so wide that many scenes have no pair. */
TEST(echoes_are_close_exactly_if_a_pair_is)
{
    size_t close_scenes = 0;
    for (uint64_t scene = 0; scene < 5000; scene++) {
        struct resolution_echo echoes[ECHO_MAX];
        size_t count = draw_echoes(scene, echoes);
        bool close = false;
        for (uint32_t i = 0; i < count; i++)
            echoes[i].range_m = 0.125 * floor(150 * draw(scene, 100 + i));
        for (size_t i = 0; i < count; i++)
            for (size_t j = 0; j < i; j++)
                close =
                    close || (fabs(echoes[i].range_m - echoes[j].range_m) <= 0.125 &&
                              fabs(echoes[i].range_rate_mps - echoes[j].range_rate_mps) <= 0.125);
        assert_int_equal(resolution_close(echoes, count, &(struct resolution){0.125, 0.125, false},
                                          check_arena()),
                         close);
        close_scenes += close;
    }
    assert_in_range(close_scenes, 1000, 4000);
}

/* Hard case 45. */
/* Two echoes are within the larger of their cells. */
static bool share(const struct resolution_echo *one, const struct resolution_echo *other,
                  double half_range_m, double half_rate_mps)
{
    double size = 1 + fmax(one->widening, other->widening);
    return fabs(one->range_m - other->range_m) <= size * half_range_m &&
           fabs(one->range_rate_mps - other->range_rate_mps) <= size * half_rate_mps;
}

/* As the rule is written: every leader asks all echoes that are left. */
static size_t cluster_all_pairs(const struct resolution_echo *echoes, size_t count,
                                double half_range_m, double half_rate_mps, size_t *cell)
{
    size_t cells = 0;
    for (size_t i = 0; i < count; i++)
        cell[i] = count;
    for (size_t leader = 0; leader < count; leader++) {
        if (cell[leader] < count)
            continue;
        for (size_t i = leader; i < count; i++)
            if (cell[i] == count && share(&echoes[i], &echoes[leader], half_range_m, half_rate_mps))
                cell[i] = cells;
        cells++;
    }
    return cells;
}

/* Some on borders, some equal, some a rounding apart; some with larger cells in half of the scenes.
 */
TEST(a_crowd_clusters_as_if_every_pair_were_asked)
{
    enum { CROWD = 300 };
    static const double half_m[] = {0.125, 0.15, 0.9};
    for (uint64_t scene = 0; scene < 500; scene++) {
        struct resolution_echo echoes[CROWD];
        size_t cell[CROWD], expected[CROWD], count = (size_t)(draw(scene, 9999) * CROWD);
        double spread = draw(scene, 9998) * 300;
        for (size_t i = 0; i < count; i++) {
            uint32_t at = (uint32_t)(3 * i);
            double step = at % 2 == 0 ? floor(draw(scene, at) * 400) / 400 : draw(scene, at);
            echoes[i] = (struct resolution_echo){
                spread * step * (1 + (double)(at % 3) * 0x1p-52),
                floor(draw(scene, at + 1) * 10) / 8, draw(scene, at + 2),
                (double)(scene % 2) * floor(draw(scene, at + 3) * 4) / 2, 0};
        }
        qsort(echoes, count, sizeof echoes[0], compare_echoes);
        double half = half_m[scene % 3];
        assert_int_equal(cluster(echoes, count, half, 0.25, cell),
                         cluster_all_pairs(echoes, count, half, 0.25, expected));
        assert_memory_equal(cell, expected, count * sizeof cell[0]);
    }
}

/* A leader with the sensor's cell takes an echo whose own cell reaches it, and the other way round.
 */
TEST(the_larger_cell_of_two_echoes_counts)
{
    for (size_t wide = 0; wide < 3; wide++) {
        struct resolution_echo echoes[] = {{10, 1, 5, 0, 0}, {10.375, 0.5, 4, 0, 0}};
        size_t cell[2], shared = wide < 2;
        if (shared)
            echoes[wide].widening = 2;
        assert_int_equal(cluster(echoes, 2, 0.125, 0.25, cell), 2 - shared);
        assert_int_equal(
            resolution_close(echoes, 2, &(struct resolution){0.125, 0.25, false}, check_arena()),
            shared);
    }
}

/* How many cells a pair makes: the second echo `apart` half cells from the first in range and
 * range rate, half as strong, at this phase. */
static size_t coherent_cells(double apart_range, double apart_rate, double phase_rad)
{
    const struct resolution resolution = {0.5, 2, true};
    const struct resolution_echo echoes[] = {
        {10, 1, 4, 0, 1}, {10 + 0.5 * apart_range, 1 - 2 * apart_rate, 2, 0, 1 + phase_rad}};
    size_t cell[2], cells = resolution_cluster(echoes, 2, &resolution, cell, check_arena());
    assert_int_equal(resolution_close(echoes, 2, &resolution, check_arena()), cells == 1);
    return cells;
}

/* Pulses have half of their amplitude at 2/3.5802 = 0.5586 half cells. */
TEST(coherent_echoes_part_by_their_phase)
{
    assert_int_equal(coherent_cells(0.999, 0, PI / 2), 1);
    assert_int_equal(coherent_cells(1.001, 0, -PI / 2), 2);
    assert_int_equal(coherent_cells(0, 0.999, PI / 2), 1);
    assert_int_equal(coherent_cells(0, 1.001, PI / 2), 2);
    assert_int_equal(coherent_cells(0.6 * 0.999, 0.8 * 0.999, PI / 2), 1);
    assert_int_equal(coherent_cells(0.6 * 1.001, 0.8 * 1.001, PI / 2), 2);
    assert_int_equal(coherent_cells(1.1, 0, 0), 1);
    assert_int_equal(coherent_cells(1.4, 0, 0), 2);
    assert_int_equal(coherent_cells(0.56, 0, PI), 2);
    assert_int_equal(coherent_cells(0.55, 0, PI), 1);
    assert_int_equal(coherent_cells(0, 0, PI), 1);
}

TEST(a_leader_leaves_of_an_echo_what_its_response_has_there)
{
    const struct resolution resolution = {0.5, 2, true};
    const struct resolution_echo leader = {10, 1, 4, 0, 0};
    struct resolution_echo echo = {10 + 0.5 * 2 / 3.5802, 1, 2, 0, 3};
    assert_close(resolution_response(&leader, &leader, &resolution), 1, 0);
    assert_close(resolution_response(&leader, &echo, &resolution), 0.5, 1e-12);
    echo.range_rate_mps += 2 * 2 / 3.5802;
    assert_close(resolution_response(&leader, &echo, &resolution), 0.25, 1e-12);
    echo.widening = 1;
    assert_close(resolution_response(&leader, &echo, &resolution), sqrt(0.5), 1e-12);
}

/* Every leader asks all echoes that are left, by the cells of pairs. */
TEST(a_coherent_crowd_clusters_as_if_every_pair_were_asked)
{
    enum { CROWD = 60 };
    const struct resolution resolution = {0.5, 0.25, true};
    for (uint64_t scene = 0; scene < 200; scene++) {
        struct resolution_echo echoes[CROWD];
        size_t cell[CROWD], expected[CROWD], cells = 0, count = (size_t)(draw(scene, 9999) * CROWD);
        for (uint32_t i = 0; i < count; i++)
            echoes[i] = (struct resolution_echo){
                100 * draw(scene, 9998) * draw(scene, 5 * i), 2 * draw(scene, 5 * i + 1),
                exp2(-9 * draw(scene, 5 * i + 2)), floor(draw(scene, 5 * i + 3) * 1.2),
                2 * PI * draw(scene, 5 * i + 4)};
        qsort(echoes, count, sizeof echoes[0], compare_echoes);
        for (size_t i = 0; i < count; i++)
            expected[i] = count;
        for (size_t leader = 0; leader < count; leader++) {
            if (expected[leader] < count)
                continue;
            expected[leader] = cells;
            for (size_t i = leader + 1; i < count; i++) {
                const struct resolution_echo pair[] = {echoes[leader], echoes[i]};
                if (expected[i] == count && resolution_close(pair, 2, &resolution, check_arena()))
                    expected[i] = cells;
            }
            cells++;
        }
        assert_int_equal(resolution_cluster(echoes, count, &resolution, cell, check_arena()),
                         cells);
        assert_memory_equal(cell, expected, count * sizeof cell[0]);
    }
}

/* Hard case 15. */
TEST(the_mean_of_equal_values_is_that_value)
{
    for (uint64_t i = 0; i < 20000; i++) {
        double value = 100 * draw(i, 0);
        double weights[] = {draw(i, 1), draw(i, 2), draw(i, 3)};
        double values[] = {value, value, value};
        assert_close(resolution_mean(values, weights, 3), value, 0);
    }
}

/* Hard case 16. */
TEST(the_mean_stays_in_the_span_and_near_the_exact_mean)
{
    for (uint64_t i = 0; i < 50000; i++) {
        double values[] = {20 * draw(i, 0) - 10, 0, 0};
        double spread = pow(10, -16 * draw(i, 1));
        double weights[] = {1, pow(10, 20 * (draw(i, 2) - 0.5)), draw(i, 3)};
        values[1] = values[0] + spread * (draw(i, 4) - 0.5);
        values[2] = values[0] + spread * (draw(i, 5) - 0.5);
        double mean = resolution_mean(values, weights, 3);
        assert_true(mean >= fmin(values[0], fmin(values[1], values[2])));
        assert_true(mean <= fmax(values[0], fmax(values[1], values[2])));
        long double sum = 0;
        long double total = 0;
        for (int k = 0; k < 3; k++) {
            sum += (long double)weights[k] * (long double)values[k];
            total += (long double)weights[k];
        }
        assert_close((double)((long double)mean - sum / total), 0, 2e-15);
    }
}

/* Hard case 17. */
TEST(weights_may_be_huge_or_tiny)
{
    static const struct {
        double weights[3], mean;
    } cases[] = {
        {{1e300, 1e300, 1e300}, 11},
        {{1e-300, 1e-300, 1e-300}, 11},
        {{1e300, 1e-300, 1e300}, 11},
        {{1e300, 1e-300, 1e-300}, 10},
        {{1.7e308, 1.7e308, 1e308}, (17 * 10 + 17 * 11 + 10 * 12) / 44.0},
    };
    for (size_t i = 0; i < COUNT(cases); i++)
        assert_near(resolution_mean((double[]){10, 11, 12}, cases[i].weights, 3), cases[i].mean,
                    1e-15);
}
