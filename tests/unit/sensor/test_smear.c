#include "array_sensor.h"
#include "check.h"

#include "base/sort.h"
#include "base/units.h"
#include "sample.h"
#include "sensor/smear.h"

enum { MOST = 8 };

static struct sensor test_sensor(void)
{
    struct sensor sensor = {.name = "s",
                            .carrier_hz = 77e9,
                            .threshold_db = 6,
                            .calibration_ercs = 0.8,
                            .calibration_range_m = 30,
                            .exponent = 2,
                            .range_floor_m = 0.5,
                            .cell_range_m = 0.5,
                            .cell_range_rate_mps = 0.25,
                            .angle_estimator = MONOPULSE_RATIO};
    suite_derive(&sensor);
    return sensor;
}

/* Echoes on boresight, placed in bins. */
struct scene {
    struct sensor sensor;
    struct received_echo echoes[MOST];
    size_t count;
    struct smear smear;
    struct cell cells[MOST];
};

static const char *const names[MOST] = {"a", "b", "c", "d", "e", "f", "g", "h"};

static struct scene *make_scene(void)
{
    static struct scene scene;
    scene = (struct scene){.sensor = test_sensor()};
    return &scene;
}

static void start(struct scene *scene)
{
    arena_clear(check_arena());
    scene->count = 0;
}

static struct received_echo *add(struct scene *scene, double range_bins, double rate_bins,
                                 double amplitude, double phase_rad)
{
    struct received_echo *received = &scene->echoes[scene->count];
    *received =
        (struct received_echo){.echo = {.id.object = "o", .id.reflector = names[scene->count]},
                               .strength = amplitude,
                               .amplitude = amplitude,
                               .range_m = 0.5 * range_bins,
                               .range_rate_mps = 0.25 * rate_bins,
                               .phase_rad = phase_rad};
    received->echo.range_m = received->range_m;
    received->echo.range_rate_mps = received->range_rate_mps;
    scene->count++;
    return received;
}

static size_t cells_of(struct scene *scene)
{
    sort_items(scene->echoes, scene->count, sizeof *scene->echoes, resolution_cell_compare,
               check_arena());
    scene->smear = smear_make(&scene->sensor, scene->echoes, scene->count, check_arena());
    for (size_t i = 0; i < scene->smear.cells; i++)
        assert_true(smear_cell(&scene->smear, i, check_arena(), &scene->cells[i]));
    return scene->smear.cells;
}

static void assert_same_cell(const struct cell *cell, const struct cell *expected)
{
    assert_close(cell->range_m, expected->range_m, 1e-13 * (1 + expected->range_m));
    assert_close(cell->range_rate_mps, expected->range_rate_mps,
                 1e-13 * (1 + fabs(expected->range_rate_mps)));
    assert_close(cell->azimuth_rad, expected->azimuth_rad, 1e-14);
    assert_near(cell->amplitude, expected->amplitude, 1e-14);
    assert_close(cell->sum_re, expected->sum_re, 1e-14 * expected->amplitude);
    assert_close(cell->sum_im, expected->sum_im, 1e-14 * expected->amplitude);
    assert_close(cell->delta_re, expected->delta_re, 1e-14 * expected->amplitude);
    assert_close(cell->delta_im, expected->delta_im, 1e-14 * expected->amplitude);
    assert_int_equal(cell->members.count, 1);
    assert_true(cell->members.items[0].weight == 1);
    assert_true(cell->effects == expected->effects);
}

#define SCENE_TEST(name) TEST_FROM(make_scene, struct scene *scene, name)

SCENE_TEST(a_single_echo_has_the_cell_of_glint_sensor)
{
    uint64_t sample = 1;
    for (int i = 0; i < 2000; i++) {
        start(scene);
        const struct echo echo = {.sensor = "s",
                                  .id.object = "o",
                                  .id.reflector = "r",
                                  .range_m = sample_between(&sample, 0.3, 200),
                                  .azimuth_rad = sample_between(&sample, -1, 1),
                                  .range_rate_mps = sample_between(&sample, -60, 60),
                                  .ercs = sample_between(&sample, 0.01, 5),
                                  .effects = EFFECT_BIT(EFFECT_RAIN)};
        struct received_echo received =
            received_echo_in_free_space(&scene->sensor, &echo, sample_between(&sample, -7, 7));
        struct smear smear = smear_make(&scene->sensor, &received, 1, check_arena());
        struct cell cell, expected;
        assert_int_equal(smear.cells, 1);
        assert_true(smear_cell(&smear, 0, check_arena(), &cell));
        assert_true(
            resolution_cell_of(&scene->sensor, &received, 1, true, check_arena(), &expected));
        assert_same_cell(&cell, &expected);
    }
}

SCENE_TEST(echoes_that_are_far_apart_do_not_touch)
{
    start(scene);
    add(scene, 100.3, 2, 7, 1);
    add(scene, 106.8, 2, 3, 2);
    add(scene, 100.3, -5.1, 2, 3);
    assert_int_equal(cells_of(scene), 3);
    for (size_t i = 0; i < 3; i++) {
        struct cell expected;
        resolution_cell_of(&scene->sensor, &scene->echoes[i], 1, true, check_arena(), &expected);
        assert_same_cell(&scene->cells[i], &expected);
    }
}

/* Two echoes of amplitude 1, so many bins apart around the middle, along range or along rate. */
static size_t pair(struct scene *scene, double middle, double spacing, double phase_rad,
                   bool along_range)
{
    start(scene);
    for (int side = -1; side <= 1; side += 2) {
        double place = middle + side * spacing / 2;
        add(scene, along_range ? place : 40, along_range ? 3 : place, 1, side * phase_rad / 2);
    }
    return cells_of(scene);
}

static double place_of(const struct cell *cell, bool along_range)
{
    return along_range ? cell->range_m / 0.5 : cell->range_rate_mps / 0.25;
}

SCENE_TEST(two_echoes_a_bin_apart_merge_unless_they_are_opposite)
{
    for (int axis = 0; axis < 2; axis++) {
        const struct cell *cell = scene->cells;
        assert_int_equal(pair(scene, 20, 1, 0, axis), 1);
        assert_close(place_of(cell, axis), 20, 1e-12);
        assert_close(units_amplitude_db(cell->amplitude), 4.60, 5e-3);
        assert_int_equal(cell->members.count, 2);
        assert_int_equal(pair(scene, 20, 1, PI / 2, axis), 1);
        assert_close(place_of(cell, axis), 20, 1e-12);
        assert_close(units_amplitude_db(cell->amplitude), 1.59, 5e-3);
        assert_int_equal(pair(scene, 20, 1, PI, axis), 2);
        assert_close(place_of(&cell[0], axis), 20 - 0.5 - 0.47, 0.25);
        assert_close(place_of(&cell[1], axis), 20 + 0.5 + 0.47, 0.25);
    }
}

SCENE_TEST(two_echoes_part_by_their_distance_and_phase)
{
    for (double middle = 20; middle < 21; middle += 0.03) {
        for (int axis = 0; axis < 2; axis++) {
            assert_int_equal(pair(scene, middle, 1.5, 0, axis), 1);
            assert_int_equal(pair(scene, middle, 1.5, PI / 2, axis), 2);
            assert_int_equal(pair(scene, middle, 1.5, PI, axis), 2);
            for (double phase_rad = 0; phase_rad < 3.2; phase_rad += 0.2)
                assert_int_equal(pair(scene, middle, 2, phase_rad, axis), 2);
        }
    }
}

SCENE_TEST(merged_echoes_read_at_the_angle_between_them)
{
    start(scene);
    add(scene, 19.9, 0.1, 1, 0)->echo.azimuth_rad = 0.1;
    add(scene, 20.1, -0.1, 1, 0)->echo.azimuth_rad = -0.1;
    assert_int_equal(cells_of(scene), 1);
    assert_close(scene->cells[0].azimuth_rad, 0, 1e-15);
    assert_true((scene->cells[0].effects & EFFECT_BIT(EFFECT_MERGING)) != 0);
    assert_true((scene->cells[0].effects & EFFECT_BIT(EFFECT_COHERENCE)) == 0);
}

SCENE_TEST(an_echo_beside_a_strong_one_is_in_its_cell)
{
    start(scene);
    add(scene, 20, 0, 1000, 0);
    add(scene, 21.3, 0.4, 1, 2);
    add(scene, 30, 0, 1, 0);
    assert_int_equal(cells_of(scene), 2);
    assert_int_equal(scene->cells[0].members.count, 2);
    assert_string_equal(scene->cells[0].members.items[0].id.reflector, "a");
    assert_string_equal(scene->cells[0].members.items[1].id.reflector, "b");
    assert_close(scene->cells[0].members.items[1].weight, 1.0 / 1001, 1e-15);
    assert_true((scene->cells[0].effects & EFFECT_BIT(EFFECT_COHERENCE)) != 0);
    assert_int_equal(scene->cells[1].members.count, 1);
}

SCENE_TEST(side_lobes_alone_are_no_cells)
{
    start(scene);
    add(scene, 20.4, 0.3, 1e6, 0);
    assert_int_equal(cells_of(scene), 1);
}

SCENE_TEST(echoes_that_cancel_have_no_amplitude)
{
    start(scene);
    add(scene, 20, 0, 1, 0);
    add(scene, 20, 0, 1, 0)->strength = -1;
    scene->smear = smear_make(&scene->sensor, scene->echoes, 2, check_arena());
    assert_int_equal(scene->smear.cells, 1);
    assert_false(smear_cell(&scene->smear, 0, check_arena(), scene->cells));
    assert_true(scene->cells[0].amplitude == 0);
    assert_int_equal(scene->cells[0].members.count, 2);
}

SCENE_TEST(every_echo_is_in_one_cell_and_weights_add_up)
{
    uint64_t sample = 5;
    for (int i = 0; i < 2000; i++) {
        start(scene);
        for (int j = 0; j < MOST; j++)
            add(scene, sample_between(&sample, 0, 8), sample_between(&sample, -3, 3),
                exp(sample_between(&sample, -5, 5)), sample_between(&sample, 0, 6.3));
        size_t cells = cells_of(scene), members = 0;
        for (size_t j = 0; j < cells; j++) {
            const struct cell *cell = &scene->cells[j];
            double total = 0;
            for (size_t k = 0; k < cell->members.count; k++)
                total += cell->members.items[k].weight;
            members += cell->members.count;
            assert_close(total, 1, 1e-15 * MOST);
            assert_true(cell->range_m >= 0);
        }
        assert_int_equal(members, MOST);
    }
}

/* Over widths of Hann's response from that at rest to eight times as much. */
SCENE_TEST(a_walking_echo_alone_keeps_its_place_and_amplitude)
{
    uint64_t sample = 1;
    for (int i = 0; i < 1000; i++) {
        start(scene);
        double range_bins = sample_between(&sample, 10, 200);
        double rate_bins = sample_between(&sample, -60, 60);
        add(scene, range_bins, rate_bins, 5, 1)->widening = sample_between(&sample, 1e-3, 8);
        assert_int_equal(cells_of(scene), 1);
        assert_close(scene->cells[0].range_m, 0.5 * range_bins, 0.5 * 0.016);
        assert_close(scene->cells[0].range_rate_mps, 0.25 * rate_bins, 0.25 * 0.016);
        assert_close(20 * log10(scene->cells[0].amplitude / 5), 0, 0.05);
    }
}

/* Equal echoes in phase, a bin and a half apart with the sum's one peak at rest (MODEL 6.1), are
 * one up to about 1.5 f bins for responses f times as wide. */
SCENE_TEST(echoes_that_walk_are_one_farther_apart)
{
    for (double width = 1; width <= 4; width *= 2)
        for (double apart = 1; apart <= 2; apart += 1) {
            start(scene);
            add(scene, 20, 8, 5, 0)->widening = width - 1;
            add(scene, 20 + apart * width, 8, 5, 0)->widening = width - 1;
            assert_int_equal(cells_of(scene), (size_t)apart);
        }
}

/* A weak echo among the side lobes of a strong one ends at a peak that lies in side lobes of its
 * own, of which every other one is negative. */
SCENE_TEST(what_an_array_sees_in_side_lobes_has_an_amplitude)
{
    uint64_t sample = 5;
    scene->sensor.beams = array_row(8, 0.5, TAPER_RECTANGULAR);
    for (int i = 0; i < 3000; i++) {
        start(scene);
        double range_bins = 40 + sample_between(&sample, 2, 12);
        double rate_bins = 8 + sample_between(&sample, 2, 12);
        double weak = pow(10, sample_between(&sample, -7, -1));
        add(scene, 40, 8, 1000, sample_between(&sample, -PI, PI));
        add(scene, range_bins, rate_bins, 1000 * weak, sample_between(&sample, -PI, PI));
        cells_of(scene);
        for (size_t j = 0; j < scene->smear.cells; j++)
            assert_true(scene->cells[j].amplitude > 0);
    }
}
