#include "check.h"

#include <float.h>

#include "propagation/roadside.h"
#include "radar/radar_equation.h"

/* chi-square with 5 and 9 degrees of freedom exceeds these with probability 0.001. */
#define CHI_SQUARE_5 20.52
#define CHI_SQUARE_9 27.88

#define CELLS 20000

static const struct random_address SCENE = {.seed = 7, .scene = 11};

/* 16 m wide, with 0.05 scatterers a square metre: 0.8 to a cell. */
static const struct roadside_strip MEADOW = {.kind = ROADSIDE_VEGETATION,
                                             .from_x_m = 100,
                                             .from_y_m = -20,
                                             .to_x_m = 100 + CELLS,
                                             .to_y_m = -20,
                                             .width_m = 16,
                                             .per_m2 = 0.05,
                                             .rcs_dbsm = -15,
                                             .spread_db = 8,
                                             .height_m = 1};

static const struct roadside_strip RAIL = {.kind = ROADSIDE_RAIL,
                                           .from_x_m = 0,
                                           .from_y_m = 0,
                                           .to_x_m = 0,
                                           .to_y_m = 4 * CELLS,
                                           .spacing_m = 4,
                                           .rcs_dbsm = -8,
                                           .spread_db = 9};

/* Scatterers of a cell of at least this ERCS, at most 100. */
static int draw(const struct roadside_strip *strip, int64_t along, int64_t across,
                double least_ercs, struct roadside_scatterer *found)
{
    struct roadside_grid grid = roadside_grid_of(strip);
    struct random_address address = roadside_address(SCENE, strip, 3);
    struct roadside_series series = roadside_series_of(&grid, address, along, across);
    int count = 0;
    while (count < 100 && roadside_next(&series, least_ercs, &found[count]))
        count++;
    return count;
}

static double chi_square(const double *seen, const double *expected, int bins)
{
    double sum = 0;
    for (int i = 0; i < bins; i++)
        sum += (seen[i] - expected[i]) * (seen[i] - expected[i]) / expected[i];
    return sum;
}

TEST(the_number_in_a_cell_is_a_poisson_count_of_the_mean_described)
{
    enum { BINS = 6 };
    struct roadside_scatterer found[100];
    double seen[BINS] = {0}, expected[BINS], chance = exp(-0.8), rest = 1;
    for (int k = 0; k + 1 < BINS; k++) {
        expected[k] = CELLS * chance;
        rest -= chance;
        chance *= 0.8 / (k + 1);
    }
    expected[BINS - 1] = CELLS * rest;
    for (int64_t cell = 0; cell < CELLS; cell++) {
        int count = draw(&MEADOW, cell / 4, cell % 4, 0, found);
        seen[count < BINS ? count : BINS - 1]++;
    }
    assert_in_range((int64_t)chi_square(seen, expected, BINS), 0, (int64_t)CHI_SQUARE_5);
}

/* Of n levels with the deviation s the mean varies by s/sqrt(n), the deviation by s/sqrt(2 n). */
TEST(levels_are_normal_in_decibels_and_fall_in_a_cell)
{
    struct roadside_scatterer found[100];
    double sum = 0, squares = 0, count = 0;
    for (int64_t cell = 0; cell < CELLS; cell++) {
        int here = draw(&MEADOW, cell / 4, cell % 4, 0, found);
        for (int i = 0; i < here; i++) {
            double dbsm = 10 * log10(radar_cross_section_m2(found[i].ercs));
            assert_true(i == 0 || found[i].ercs < found[i - 1].ercs);
            assert_int_equal(found[i].number, 1 + 1024 * cell + i);
            sum += dbsm;
            squares += dbsm * dbsm;
            count++;
        }
    }
    double mean = sum / count;
    assert_close(mean, -15, 4 * 8 / sqrt(count));
    assert_close(sqrt(squares / count - mean * mean), 8, 4 * 8 / sqrt(2 * count));
}

TEST(a_reader_that_stops_early_has_missed_nothing_above_its_level)
{
    struct roadside_scatterer all[100], strong[100];
    int kept = 0, left = 0;
    for (int64_t cell = 0; cell < 1000; cell++)
        for (double least = 0.02; least < 2; least *= 3) {
            int count = draw(&MEADOW, cell, 1, 0, all), few = draw(&MEADOW, cell, 1, least, strong);
            for (int i = 0; i < count; i++)
                assert_true((i < few) == (all[i].ercs >= least));
            assert_memory_equal(all, strong, (size_t)few * sizeof *all);
            kept += few;
            left += count - few;
        }
    assert_true(kept > 500 && left > 500);
}

TEST(a_rail_has_one_post_a_spacing_at_a_uniform_place)
{
    enum { BINS = 10 };
    struct roadside_scatterer found[100];
    double seen[BINS] = {0}, expected[BINS];
    for (int64_t cell = 0; cell < CELLS; cell++) {
        assert_int_equal(draw(&RAIL, cell, 0, 0, found), 1);
        double within = found[0].place_m.y / 4 - (double)cell;
        assert_true(within >= 0 && within < 1);
        assert_close(found[0].place_m.x, 0, 1e-9);
        seen[(int)(BINS * within)]++;
    }
    for (int i = 0; i < BINS; i++)
        expected[i] = (double)CELLS / BINS;
    assert_in_range((int64_t)chi_square(seen, expected, BINS), 0, (int64_t)CHI_SQUARE_9);
}

/* Strips of 10 m: cells of 4, 4 and 2 m. Their counts are Poisson with the mean of their area. */
TEST(nothing_stands_outside_a_strip)
{
    struct roadside_scatterer found[100];
    double count = 0, strips = 5000;
    for (int64_t i = 0; i < (int64_t)strips; i++) {
        struct roadside_strip strip = MEADOW;
        struct roadside_grid grid;
        strip.to_x_m = strip.from_x_m + 6;
        strip.to_y_m = strip.from_y_m + 8;
        strip.width_m = 5;
        grid = roadside_grid_of(&strip);
        assert_int_equal(grid.along_count, 3);
        assert_int_equal(grid.across_count, 2);
        for (int64_t cell = 0; cell < 6; cell++) {
            struct random_address strip_address = {.seed = 7, .scene = (uint64_t)i};
            struct roadside_series series =
                roadside_series_of(&grid, strip_address, cell / 2, cell % 2);
            while (roadside_next(&series, 0, found)) {
                struct vec2 from = vec2_sub(found->place_m, grid.from_m);
                double along_m = vec2_dot(from, grid.heading);
                assert_true(along_m >= 0 && along_m <= 10);
                assert_true(fabs(vec2_cross(grid.heading, from)) <= 2.5);
                count++;
            }
        }
    }
    assert_close(count, strips * 2.5, 4 * sqrt(strips * 2.5));
}

TEST(cells_strips_and_scenes_have_draws_of_their_own)
{
    struct roadside_grid grid = roadside_grid_of(&RAIL);
    double ercs[5];
    struct roadside_scatterer one;
    for (int i = 0; i < 5; i++) {
        struct random_address scene = {.seed = 7 + (i == 1), .scene = 11 + (i == 2)};
        struct random_address strip = roadside_address(scene, &RAIL, i == 3 ? 2 : 1);
        struct roadside_series series = roadside_series_of(&grid, strip, i == 4 ? 1 : 0, 0);
        assert_true(roadside_next(&series, 0, &one));
        ercs[i] = one.ercs;
        for (int before = 0; before < i; before++)
            assert_true(ercs[before] != ercs[i]);
    }
}

/* Ten bins over a meadow of four cells, 16 m from side to side: each cell has its own part of them.
 */
TEST(scatterers_are_uniform_across_a_strip_and_each_in_its_cell)
{
    enum { BINS = 10 };
    struct roadside_scatterer found[100];
    double seen[BINS] = {0}, expected[BINS], count = 0;
    for (int64_t cell = 0; cell < CELLS; cell++) {
        int here = draw(&MEADOW, cell / 4, cell % 4, 0, found);
        for (int i = 0; i < here; i++) {
            double left_m = found[i].place_m.y - MEADOW.from_y_m + 8;
            assert_int_equal((int64_t)floor(left_m / 4), cell % 4);
            seen[(int)(BINS * left_m / 16)]++;
            count++;
        }
    }
    for (int i = 0; i < BINS; i++)
        expected[i] = count / BINS;
    assert_in_range((int64_t)chi_square(seen, expected, BINS), 0, (int64_t)CHI_SQUARE_9);
}

/* The correlation of the two places within a cell, each from -1/2 to 1/2, is that of independent
 * draws: the sum of 12 times their products has the variance of their number. */
TEST(places_along_a_strip_tell_nothing_of_those_across)
{
    struct roadside_scatterer found[100];
    double sum = 0, count = 0;
    for (int64_t cell = 0; cell < CELLS; cell++) {
        int here = draw(&MEADOW, cell / 4, cell % 4, 0, found);
        for (int i = 0; i < here; i++) {
            double along = (found[i].place_m.x - MEADOW.from_x_m) / 4;
            double across = (found[i].place_m.y - MEADOW.from_y_m + 8) / 4;
            sum += 12 * (along - floor(along) - 0.5) * (across - floor(across) - 0.5);
            count++;
        }
    }
    assert_close(sum, 0, 4 * sqrt(count));
}

TEST(cells_beside_each_other_across_a_strip_have_draws_of_their_own)
{
    struct roadside_scatterer found[4][100];
    int alike = 0, compared = 0;
    for (int64_t along = 0; along < 100; along++)
        for (int64_t across = 0; across < 4; across++) {
            int count = draw(&MEADOW, along, across, 0, found[across]);
            if (across == 0 || count == 0 || draw(&MEADOW, along, across - 1, 0, found[0]) == 0)
                continue;
            compared++;
            alike += found[across][0].ercs == found[0][0].ercs;
        }
    assert_true(compared > 50);
    assert_int_equal(alike, 0);
}

TEST(absent_numbers_are_those_of_the_kind)
{
    struct roadside_strip rail = {0};
    field_clear(&roadside_strip_record, &rail);
    rail.kind = ROADSIDE_RAIL;
    rail.to_x_m = 20;
    struct roadside_grid grid = roadside_grid_of(&rail);
    assert_true(grid.spaced);
    assert_int_equal(grid.along_count, 5);
    assert_close(grid.median_ercs, radar_ercs(pow(10, -0.95)), 1e-12);
    assert_close(grid.spread, 9 * log(10) / 20, 1e-12);
    assert_close(grid.height_m, 0.75, 0);
    rail.per_m2 = 2;
    rail.width_m = 3;
    rail.spread_db = 0;
    grid = roadside_grid_of(&rail);
    assert_false(grid.spaced);
    assert_close(grid.mean, 24, 1e-12);
    assert_close(grid.spread, 0, 0);
}

/* What another strip has, and how long it is, is no part of an address. */
TEST(the_level_of_a_scatterer_is_its_own_and_changes_with_range)
{
    struct random_address one = roadside_address(SCENE, &RAIL, 1);
    struct random_address other = roadside_address(SCENE, &RAIL, 2);
    double level = roadside_level(one, 7, 30.5);
    assert_true(level == roadside_level(one, 7, 30.5));
    assert_true(level != roadside_level(one, 8, 30.5));
    assert_true(level != roadside_level(other, 7, 30.5));
    assert_close(roadside_level(one, 7, 30.5 + 1e-9), level, 1e-7);
    assert_true(fabs(roadside_level(one, 7, 33.5) - level) > 1e-3);
}

TEST(rounding_of_a_length_makes_no_cell)
{
    struct roadside_strip rail = RAIL, meadow = MEADOW;
    for (int i = -3; i <= 3; i++) {
        rail.to_y_m = 600 * (1 + i * DBL_EPSILON);
        assert_int_equal(roadside_grid_of(&rail).along_count, 150);
        meadow.width_m = 16 * (1 + i * DBL_EPSILON);
        assert_int_equal(roadside_grid_of(&meadow).across_count, 4);
    }
    rail.to_y_m = 600.001;
    assert_int_equal(roadside_grid_of(&rail).along_count, 151);
}

/* Turned by any angle and anywhere, a strip has the same scatterers at the same places along it. */
TEST(a_turned_and_shifted_strip_has_the_same_scatterers)
{
    struct roadside_scatterer found[100], turned[100];
    for (int turn = 1; turn < 12; turn++) {
        struct roadside_strip strip = RAIL;
        strip.from_x_m = 3e5;
        strip.from_y_m = 5e6;
        strip.to_x_m = strip.from_x_m + 600 * sin(turn * 0.5);
        strip.to_y_m = strip.from_y_m + 600 * cos(turn * 0.5);
        assert_int_equal(roadside_grid_of(&strip).along_count, 150);
        for (int64_t cell = 0; cell < 150; cell++) {
            assert_int_equal(draw(&RAIL, cell, 0, 0, found), 1);
            assert_int_equal(draw(&strip, cell, 0, 0, turned), 1);
            struct vec2 from = {strip.from_x_m, strip.from_y_m};
            assert_int_equal(found->number, turned->number);
            assert_true(found->ercs == turned->ercs);
            assert_close(vec2_length(vec2_sub(turned->place_m, from)), found->place_m.y, 1e-8);
        }
    }
}

TEST(a_name_is_the_id_or_else_kind_and_number)
{
    struct arena *arena = check_arena();
    struct roadside_strip strips[] = {RAIL, MEADOW, RAIL};
    assert_string_equal(roadside_name(&strips[1], 2, arena), "vegetation_2");
    strips[0].id = "left";
    assert_string_equal(roadside_name(&strips[0], 1, arena), "left");
    assert_null(roadside_name_twice(strips, 3, arena));
    strips[0].id = "rail_3";
    assert_string_equal(roadside_name_twice(strips, 3, arena), "rail_3");
}

TEST(a_strip_with_an_id_has_the_same_draws_anywhere_in_the_list)
{
    struct roadside_strip left = RAIL, right = RAIL;
    left.id = "left";
    right.id = "right";
    struct random_address first = roadside_address(SCENE, &left, 1);
    struct random_address moved = roadside_address(SCENE, &left, 7);
    assert_memory_equal(&first, &moved, sizeof first);
    assert_true(first.frame != roadside_address(SCENE, &right, 1).frame);
    assert_true(roadside_address(SCENE, &RAIL, 1).frame != roadside_address(SCENE, &RAIL, 2).frame);
}

TEST(a_strip_without_length_or_number_has_nothing)
{
    struct roadside_scatterer found[100];
    struct roadside_strip point = RAIL, bare = MEADOW;
    point.to_y_m = 0;
    bare.kind = ROADSIDE_OTHER;
    bare.per_m2 = 0;
    assert_int_equal(roadside_grid_of(&point).along_count, 0);
    assert_int_equal(draw(&bare, 0, 0, 0, found), 0);
}
