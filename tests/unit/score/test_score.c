#include "check.h"

#include "sample.h"
#include "score/score.h"

/* Two scans with a cut-off of 2, where each item left alone costs c^2/2 = 2: two pairs 1 and 1/2
 * apart and a false item; then one pair, its d^2 being 1/2, and two missed. */
static struct score_tally two_scans(void)
{
    struct score_tally tally = {.sensor = "front"};
    score_add_scan(&tally, 1 + 0.25, 2, 2, 3, 2);
    score_add_scan(&tally, 0.5, 1, 3, 1, 2);
    return tally;
}

TEST(counts_are_sums_over_the_scans)
{
    struct score_tally tally = two_scans();
    struct score score = score_of(&tally, 1, check_arena());
    assert_string_equal(score.sensor, "front");
    assert_int_equal(score.scans, 2);
    assert_int_equal(score.true_count, 5);
    assert_int_equal(score.listed_count, 4);
    assert_int_equal(score.pair_count, 3);
    assert_int_equal(score.missed_count, 2);
    assert_int_equal(score.false_count, 1);
}

/* GOSPA^2 is 1.25 + 2 of the first scan and 0.5 + 4 of the second; OSPA^2 is (1.25 + 4)/3 and
 * (0.5 + 8)/3. */
TEST(metrics_are_means_over_the_scans)
{
    struct score_tally tally = two_scans();
    struct score score = score_of(&tally, 1, check_arena());
    assert_near(score.gospa, (sqrt(3.25) + sqrt(4.5)) / 2, 1e-15);
    assert_near(score.gospa_rms, sqrt((3.25 + 4.5) / 2), 1e-15);
    assert_near(score.gospa_max, sqrt(4.5), 1e-15);
    assert_near(score.gospa_localisation, 1.75 / 2, 1e-15);
    assert_near(score.gospa_missed, 4 / 2.0, 1e-15);
    assert_near(score.gospa_false, 2 / 2.0, 1e-15);
    assert_near(score.ospa, (sqrt(5.25 / 3) + sqrt(8.5 / 3)) / 2, 1e-15);
}

TEST(without_any_scan_all_is_zero)
{
    struct score score = score_of(NULL, 0, check_arena());
    assert_null(score.sensor);
    assert_int_equal(score.scans, 0);
    assert_close(score.gospa + score.gospa_rms + score.gospa_max + score.ospa, 0, 0);
    assert_close(score.gospa_localisation + score.gospa_missed + score.gospa_false, 0, 0);
    for (int i = 0; i < SCORE_COMPONENTS; i++)
        assert_int_equal(score.differences[i].present, 0);
}

static void add(struct score_tally *tally, enum score_kind kind, double value, struct arena *arena)
{
    *list_add(&tally->values[kind][SCORE_AZIMUTH].list, arena) = value;
}

TEST(differences_are_those_of_the_pairs_and_of_the_lists)
{
    struct arena *arena = check_arena();
    struct score_tally tallies[2] = {{.sensor = "front"}, {.sensor = "rear"}};
    static const double apart[] = {-1, 1, 1, 3};
    for (int i = 0; i < 4; i++)
        add(&tallies[i / 2], SCORE_ERROR, apart[i], arena);
    for (int i = 0; i < 3; i++) {
        add(&tallies[0], SCORE_TRUTH, i, arena);
        add(&tallies[1], SCORE_LISTED, 4 - i, arena);
    }
    struct score score = score_of(tallies, 2, arena);
    const struct score_differences *azimuth = &score.differences[SCORE_AZIMUTH];
    assert_int_equal(azimuth->present, SCORE_PAIRS | SCORE_LISTS);
    assert_close(azimuth->mean, 1, 1e-15);
    assert_near(azimuth->rms, sqrt(3), 1e-15);
    assert_close(azimuth->p95, 3, 0);
    assert_close(azimuth->max, 3, 0);
    assert_close(azimuth->wasserstein, 2, 1e-15);
    assert_int_equal(score.differences[SCORE_RANGE].present, 0);
}

TEST(a_list_without_counterpart_has_no_distance)
{
    struct arena *arena = check_arena();
    struct score_tally tally = {.sensor = "front"};
    add(&tally, SCORE_LISTED, 1, arena);
    assert_int_equal(score_of(&tally, 1, arena).differences[SCORE_AZIMUTH].present, 0);
    add(&tally, SCORE_TRUTH, 2, arena);
    assert_int_equal(score_of(&tally, 1, arena).differences[SCORE_AZIMUTH].present, SCORE_LISTS);
}

/* 19 of 20 are no larger than 1, though the one that is larger is all that the second tally has. */
TEST(quantiles_are_of_all_values_and_no_mean_of_quantiles)
{
    struct arena *arena = check_arena();
    struct score_tally tallies[2] = {{.sensor = "front"}, {.sensor = "rear"}};
    for (int i = 0; i < 19; i++)
        add(&tallies[0], SCORE_ERROR, 1, arena);
    add(&tallies[1], SCORE_ERROR, 100, arena);
    assert_close(score_of(tallies, 2, arena).differences[SCORE_AZIMUTH].p95, 1, 0);
    assert_close(score_of(&tallies[1], 1, arena).differences[SCORE_AZIMUTH].p95, 100, 0);
}

/* Scores have gaps between members: what they say is compared. */
static void assert_same(const struct score *one, const struct score *other)
{
    assert_int_equal(one->scans, other->scans);
    assert_int_equal(one->true_count, other->true_count);
    assert_int_equal(one->missed_count, other->missed_count);
    assert_int_equal(one->false_count, other->false_count);
    assert_close(one->gospa, other->gospa, 0);
    assert_close(one->gospa_rms, other->gospa_rms, 0);
    assert_close(one->gospa_max, other->gospa_max, 0);
    assert_close(one->ospa, other->ospa, 0);
    for (int i = 0; i < SCORE_COMPONENTS; i++) {
        assert_int_equal(one->differences[i].present, other->differences[i].present);
        assert_close(one->differences[i].rms, other->differences[i].rms, 0);
        assert_close(one->differences[i].wasserstein, other->differences[i].wasserstein, 0);
    }
}

TEST(a_merged_tally_says_what_both_say_together)
{
    struct arena *arena = check_arena();
    struct score_tally tallies[2] = {{.sensor = "rear"}, two_scans()};
    score_add_scan(&tallies[0], 9, 1, 1, 4, 8);
    for (int i = 0; i < SCORE_COMPONENTS; i++)
        for (int kind = 0; kind < SCORE_KINDS; kind++) {
            *list_add(&tallies[0].values[kind][i].list, arena) = i + 3 * kind;
            *list_add(&tallies[1].values[kind][i].list, arena) = 10 * i - kind;
        }
    struct score apart = score_of(tallies, 2, arena);
    score_merge(&tallies[0], &tallies[1], arena);
    struct score merged = score_of(tallies, 1, arena);
    assert_same(&merged, &apart);
    assert_near(merged.gospa_max, sqrt(9 + 3 * 8 * 8 / 2.0), 1e-15);
}

TEST(scans_are_kept_by_sensor_and_summed_up_by_name)
{
    struct score_tallies tallies = {0};
    static const char *const sensors[] = {"rear", "front", "rear", "left"};
    char name[8];
    for (size_t i = 0; i < 4; i++) {
        strcpy(name, sensors[i]);
        struct score_tally scan = {.sensor = name};
        score_add_scan(&scan, 0, 0, i + 1, 0, 2);
        score_merge_sensor(&tallies, &scan, check_arena());
        strcpy(name, "gone");
    }
    assert_int_equal(tallies.list.count, 3);
    struct score_summary summary = {0};
    score_summarize(&tallies, &summary, check_arena());
    static const struct {
        const char *sensor;
        int64_t scans, missed;
    } expected[] = {{"front", 1, 2}, {"left", 1, 4}, {"rear", 2, 1 + 3}};
    assert_int_equal(summary.sensors.count, 3);
    for (size_t i = 0; i < 3; i++) {
        assert_string_equal(summary.sensors.items[i].sensor, expected[i].sensor);
        assert_int_equal(summary.sensors.items[i].scans, expected[i].scans);
        assert_int_equal(summary.sensors.items[i].missed_count, expected[i].missed);
    }
    assert_null(summary.all.sensor);
    assert_int_equal(summary.all.scans, 4);
    assert_int_equal(summary.all.missed_count, 10);
}

TEST(the_mean_is_signed_and_the_other_figures_are_sizes)
{
    struct score_differences of = score_statistics((double[]){-3, 1, 1, 1}, 4, check_arena());
    assert_close(of.mean, 0, 0);
    assert_near(of.rms, sqrt(3), 1e-15);
    assert_close(of.max, 3, 0);
    of = score_statistics((double[]){-2}, 1, check_arena());
    assert_close(of.mean, -2, 0);
    assert_close(of.rms, 2, 0);
    assert_close(of.p95, 2, 0);
    assert_close(of.max, 2, 0);
}

TEST(ninety_five_of_a_hundred_are_no_larger)
{
    struct arena *arena = check_arena();
    double values[100];
    for (int i = 0; i < 100; i++)
        values[i] = (i % 2 == 0 ? 1 : -1) * (100 - i);
    assert_close(score_statistics(values, 100, arena).p95, 95, 0);
    assert_close(score_statistics(values, 19, arena).p95, 19, 0);
    assert_close(score_statistics(values, 20, arena).p95, 19, 0);
}

TEST(a_shifted_sample_is_apart_by_its_shift)
{
    struct arena *arena = check_arena();
    uint64_t sample = 1;
    double one[40], other[40], same[40];
    for (int round = 0; round < 200; round++) {
        double shift = sample_between(&sample, -10, 10);
        for (int i = 0; i < 40; i++) {
            one[i] = sample_between(&sample, -5, 5);
            other[39 - i] = one[i] + shift;
            same[(i + 7) % 40] = one[i];
        }
        assert_close(score_wasserstein(one, 40, other, 40, arena), fabs(shift), 1e-13);
        assert_close(score_wasserstein(one, 40, same, 40, arena), 0, 0);
        arena_clear(arena);
    }
}

TEST(samples_of_different_sizes_share_their_mass)
{
    struct arena *arena = check_arena();
    double zero[] = {0}, pair[] = {3, 1}, three[] = {0, 3, 3};
    assert_near(score_wasserstein(zero, 1, pair, 2, arena), 2.0, 1e-15);
    assert_near(score_wasserstein(three, 3, zero, 1, arena), 2.0, 1e-15);
    /* Up to the quantile 1/3 the values are 1 and 0, up to 1/2 they are 1 and 3, then both are
     * 3. */
    assert_near(score_wasserstein(pair, 2, three, 3, arena), 2.0 / 6 + 1.0 / 3, 1e-15);
}

/* Compared with the definition over quantiles: the mean of |sorted one - sorted other| for equal
 * counts. */
TEST(samples_of_one_size_are_apart_as_their_sorted_values)
{
    uint64_t sample = 3;
    for (int round = 0; round < 1000; round++) {
        double one[2], other[2];
        for (int i = 0; i < 2; i++) {
            one[i] = sample_between(&sample, -1, 1);
            other[i] = sample_between(&sample, -1, 1);
        }
        double expected = (fabs(fmin(one[0], one[1]) - fmin(other[0], other[1])) +
                           fabs(fmax(one[0], one[1]) - fmax(other[0], other[1]))) /
                          2;
        assert_close(score_wasserstein(one, 2, other, 2, check_arena()), expected, 1e-15);
        arena_clear(check_arena());
    }
}
