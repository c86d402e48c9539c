#include "check.h"

#include "base/units.h"
#include "sample.h"
#include "score/gospa.h"
#include "score/target_score.h"
#include "text/record_write.h"

enum { MOST = 8 };

static const struct target_cell cell = {0.5, 0.1, 0.25};

/* A frame of one radar with these targets. */
struct score_scene {
    struct sensor_view view;
    struct target targets[MOST];
    struct frame frame;
};

static void fill(struct score_scene *scene, size_t count)
{
    scene->view = (struct sensor_view){
        .name = "front", .cell_range_m = 1, .cell_range_rate_mps = 1, .measured = true};
    scene->frame = (struct frame){.sensors.list = {&scene->view, 1, 1},
                                  .targets = {scene->targets, count, MOST}};
}

static struct target draw_target(uint64_t *sample)
{
    return (struct target){.sensor = "front",
                           .range_m = sample_between(sample, 10, 12),
                           .azimuth_rad = sample_between(sample, -0.2, 0.2),
                           .range_rate_mps = (double)sample_integer(sample, 2) / 4,
                           .amplitude_db = sample_between(sample, 6, 30)};
}

static void draw(struct score_scene *scene, uint64_t *sample)
{
    size_t count = sample_bits(sample) % (MOST + 1);
    for (size_t i = 0; i < count; i++)
        scene->targets[i] = draw_target(sample);
    fill(scene, count);
}

static struct score score_scan(const struct score_scene *truth, const struct score_scene *listed,
                               struct arena *arena)
{
    struct score_tally tally = {.sensor = "front"};
    target_score_scan(&tally, &truth->frame, &listed->frame, &cell, arena);
    return score_of(&tally, 1, arena);
}

static void assert_same_text(const struct score *one, const struct score *other)
{
    struct text *text = check_text(), *other_text = check_text();
    record_write(&score_record, one, NULL, text);
    record_write(&score_record, other, NULL, other_text);
    assert_int_equal(text->length, other_text->length);
    assert_memory_equal(text->bytes, other_text->bytes, text->length);
}

TEST(the_azimuth_cell_is_the_option_the_suites_or_a_twentieth_of_the_view)
{
    struct sensor_view view = {.cell_range_m = 1, .cell_range_rate_mps = 2, .field_of_view_rad = 3};
    assert_close(target_score_cell(&view, 0).azimuth_rad, 0.15, 1e-16);
    view.azimuth_cell_rad = 0.02;
    assert_close(target_score_cell(&view, 0).azimuth_rad, 0.02, 0);
    assert_close(target_score_cell(&view, 0.07).azimuth_rad, 0.07, 0);
}

TEST(one_cell_is_a_distance_of_one_in_each_component)
{
    const struct target at = {.range_m = 10, .azimuth_rad = 0.2, .range_rate_mps = -3};
    struct target range = at, azimuth = at, rate = at, all = at, louder = at;
    range.range_m += 0.5;
    azimuth.azimuth_rad -= 0.1;
    rate.range_rate_mps += 0.25;
    all.range_m -= 1;
    all.azimuth_rad += 0.2;
    all.range_rate_mps += 0.25;
    louder.amplitude_db = 20;
    assert_near(target_score_distance(&at, &range, &cell), 1.0, 1e-15);
    assert_near(target_score_distance(&at, &azimuth, &cell), 1.0, 1e-15);
    assert_near(target_score_distance(&at, &rate, &cell), 1.0, 1e-15);
    assert_near(target_score_distance(&at, &all, &cell), 3.0, 1e-15);
    assert_close(target_score_distance(&at, &louder, &cell), 0, 0);
}

TEST(azimuths_differ_the_short_way_round)
{
    struct score_scene left = {.targets = {{.sensor = "front", .azimuth_rad = PI - 0.01}}};
    struct score_scene right = {.targets = {{.sensor = "front", .azimuth_rad = 0.02 - PI}}};
    fill(&left, 1);
    fill(&right, 1);
    assert_close(target_score_distance(&left.targets[0], &right.targets[0], &cell), 0.3, 1e-14);
    struct score score = score_scan(&left, &right, check_arena());
    assert_close(score.differences[SCORE_AZIMUTH].mean, 0.03, 1e-15);
}

TEST(the_order_of_targets_changes_no_bit)
{
    struct arena *arena = check_arena();
    uint64_t sample = 1;
    for (int round = 0; round < 2000; round++) {
        struct score_scene truth, listed, turned;
        draw(&truth, &sample);
        draw(&listed, &sample);
        size_t count = listed.frame.targets.count;
        for (size_t i = 0; i < count; i++)
            turned.targets[i] = listed.targets[count - 1 - i];
        fill(&turned, count);
        struct score one = score_scan(&truth, &listed, arena);
        struct score other = score_scan(&truth, &turned, arena);
        assert_same_text(&one, &other);
        arena_clear(arena);
    }
}

/* With both lists exchanged, missed targets are false ones and differences change their sign. */
TEST(scores_are_symmetric)
{
    struct arena *arena = check_arena();
    uint64_t sample = 2;
    for (int round = 0; round < 2000; round++) {
        struct score_scene truth, listed;
        draw(&truth, &sample);
        draw(&listed, &sample);
        struct score there = score_scan(&truth, &listed, arena);
        struct score back = score_scan(&listed, &truth, arena);
        assert_close(back.gospa, there.gospa, 1e-14);
        assert_close(back.ospa, there.ospa, 1e-14);
        assert_int_equal(back.missed_count, there.false_count);
        assert_close(back.gospa_missed, there.gospa_false, 0);
        for (int i = 0; i <= SCORE_AMPLITUDE; i++) {
            assert_int_equal(back.differences[i].present, there.differences[i].present);
            assert_close(back.differences[i].mean, -there.differences[i].mean, 1e-13);
            assert_close(back.differences[i].wasserstein, there.differences[i].wasserstein, 1e-13);
        }
        arena_clear(arena);
    }
}

TEST(a_list_has_no_distance_from_itself)
{
    uint64_t sample = 3;
    for (int round = 0; round < 200; round++) {
        struct score_scene scene;
        draw(&scene, &sample);
        struct score score = score_scan(&scene, &scene, check_arena());
        assert_close(score.gospa, 0, 0);
        assert_close(score.ospa, 0, 0);
        assert_int_equal(score.pair_count, scene.frame.targets.count);
        assert_close(score.differences[SCORE_RANGE].wasserstein, 0, 0);
        arena_clear(check_arena());
    }
}

/* Half the squared cut-off for every target without a partner, and the squares of the pairs. */
static double cost_of(double squares, size_t pairs, size_t targets)
{
    return squares + 2 * (double)(targets - 2 * pairs);
}

TEST(groups_are_paired_as_cheaply_as_whole_lists)
{
    uint64_t sample = 9;
    struct arena *arena = check_arena();
    size_t found = 0;
    for (int round = 0; round < 5000; round++) {
        struct score_scene truth, list;
        draw(&truth, &sample);
        draw(&list, &sample);
        size_t rows = truth.frame.targets.count, columns = list.frame.targets.count;
        for (size_t i = 0; i < columns; i++)
            list.targets[i].range_m = sample_between(&sample, 9, 14);
        struct target_pairs pairs =
            target_score_pairs("front", &truth.frame, &list.frame, &cell, arena);
        double squares = 0, whole = 0, distance[MOST * MOST];
        size_t count = 0, item_of[MOST];
        for (size_t i = 0; i < pairs.list.count; i++) {
            const struct target_pair *pair = &pairs.list.items[i];
            if (pair->truth == NULL || pair->listed == NULL)
                continue;
            squares += pow(target_score_distance(pair->truth, pair->listed, &cell), 2);
            count++;
        }
        assert_int_equal(pairs.list.count, rows + columns - count);
        for (size_t i = 0; i < rows * columns; i++)
            distance[i] = target_score_distance(&truth.targets[i / columns],
                                                &list.targets[i % columns], &cell);
        size_t wanted = gospa_pair(distance, rows, columns, TARGET_SCORE_CUTOFF, item_of, arena);
        for (size_t i = 0; i < rows; i++)
            whole += item_of[i] < columns ? pow(distance[i * columns + item_of[i]], 2) : 0;
        assert_close(cost_of(squares, count, rows + columns),
                     cost_of(whole, wanted, rows + columns), 1e-12);
        found += count;
        arena_clear(arena);
    }
    assert_true(found > 5000);
}

TEST(targets_of_other_sensors_do_not_count)
{
    struct score_scene truth = {.targets = {{.sensor = "front", .range_m = 5}}};
    struct score_scene listed = {
        .targets = {{.sensor = "front", .range_m = 5}, {.sensor = "rear", .range_m = 5}}};
    fill(&truth, 1);
    fill(&listed, 2);
    assert_int_equal(score_scan(&truth, &listed, check_arena()).listed_count, 1);
}

/* Means are over scans, differences over all pairs; the merged tally of parts equals the tally of
 * all. */
TEST(tallies_add_up)
{
    struct arena *arena = check_arena();
    struct score_tally near = {.sensor = "front"}, far = {.sensor = "front"}, both = {0};
    struct score_scene truth = {.targets = {{.sensor = "front", .range_m = 5}}};
    struct score_scene one = {.targets = {{.sensor = "front", .range_m = 5.25}}};
    fill(&truth, 1);
    fill(&one, 1);
    target_score_scan(&near, &truth.frame, &one.frame, &cell, arena);
    fill(&one, 0);
    target_score_scan(&far, &truth.frame, &one.frame, &cell, arena);
    score_merge(&both, &near, arena);
    score_merge(&both, &far, arena);
    struct score score = score_of(&both, 1, arena);
    assert_int_equal(score.scans, 2);
    assert_int_equal(score.true_count, 2);
    assert_int_equal(score.missed_count, 1);
    assert_close(score.gospa, (0.5 + sqrt(2)) / 2, 1e-15);
    assert_close(score.gospa_rms, sqrt((0.25 + 2) / 2), 1e-15);
    assert_close(score.gospa_max, sqrt(2), 1e-15);
    assert_close(score.ospa, (0.5 + 2) / 2, 1e-15);
    assert_close(score.gospa_localisation, 0.125, 1e-15);
    assert_close(score.gospa_missed, 1, 0);
    assert_close(score.differences[SCORE_RANGE].mean, 0.25, 1e-15);
    assert_close(score.differences[SCORE_RANGE].wasserstein, 0.25, 1e-15);
}

TEST(without_scans_all_is_zero)
{
    struct score_tallies none = {0};
    struct score_summary summary = {0};
    score_summarize(&none, &summary, check_arena());
    assert_int_equal(summary.all.scans, 0);
    assert_close(summary.all.gospa_rms, 0, 0);
    assert_int_equal(summary.all.differences[SCORE_RANGE].present, 0);
    assert_int_equal(summary.sensors.count, 0);
}
