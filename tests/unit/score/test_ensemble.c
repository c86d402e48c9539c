#include "check.h"

#include "base/units.h"
#include "sample.h"
#include "score/ensemble.h"
#include "score/gospa.h"
#include "score/target_score.h"

/* Cells of 2 m, 0.5 m/s and, a twentieth of the view, 0.05 rad. */
static const struct sensor_view VIEW = {.name = "front",
                                        .field_of_view_rad = 1,
                                        .cell_range_m = 2,
                                        .cell_range_rate_mps = 0.5,
                                        .measured = true};

/* One stream with one scene "s", a seed per list, and its frame. */
struct stream {
    struct ensemble ensemble;
    struct frame frame;
};

static void begin(struct stream *stream, uint64_t seed)
{
    memset(stream, 0, sizeof *stream);
    stream->ensemble.arena = stream->frame.arena = check_arena();
    stream->frame.scene = "s";
    stream->frame.seed = seed;
    *list_add(&stream->frame.sensors.list, check_arena()) = VIEW;
}

/* Adds the next seed's list: count targets at these ranges. */
static void add(struct stream *stream, const double *range_m, size_t count)
{
    stream->frame.seed++;
    stream->frame.targets.count = 0;
    for (size_t i = 0; i < count; i++)
        *list_add(&stream->frame.targets, check_arena()) =
            (struct target){.sensor = "front", .range_m = range_m[i], .amplitude_db = 20};
    assert_done(ensemble_add, &stream->ensemble, &stream->frame);
}

static struct ensemble_score compare(struct stream *truth, struct stream *listed)
{
    struct diag diag = {0};
    struct ensemble_score score;
    int result =
        ensemble_compare(&truth->ensemble, &listed->ensemble, 0, check_arena(), &score, &diag);
    if (result != 0)
        print_error("%s\n", diag.text);
    assert_int_equal(result, 0);
    return score;
}

/* For fixed lists D is twice their distance. One target is shifted by s cells in range; the other
 * is in both lists and cancels. */
TEST(shifted_lists_are_at_twice_their_distance)
{
    for (double cells = 0; cells <= 4; cells += 0.5) {
        struct stream truth, listed;
        begin(&truth, 0), begin(&listed, 100);
        for (int seed = 0; seed < 3; seed++) {
            add(&truth, (double[]){20, 60}, 2);
            add(&listed, (double[]){20 + 2 * cells, 60}, 2);
        }
        struct ensemble_score score = compare(&truth, &listed);
        double s = cells, sum = 0;
        for (int i = 0; i < 3; i++) {
            double width[] = {1, 3, 10}, w = 2 * width[i] * width[i];
            sum += 2 * (1 - exp(-s * s / w));
        }
        assert_close(score.energy, 2 * sqrt(sum), 1e-12);
        assert_close(score.scenes.items[0].energy_error, 0, 1e-12);
    }
}

/* A target seen in one of four lists against three of four: the U-statistic by hand. */
TEST(a_target_listed_less_often_gives_the_distance_by_hand)
{
    struct stream truth, listed;
    begin(&truth, 0), begin(&listed, 100);
    for (int seed = 0; seed < 4; seed++) {
        add(&truth, (double[]){20}, seed < 3);
        add(&listed, (double[]){20}, seed < 1);
    }
    struct ensemble_score score = compare(&truth, &listed);
    /* 2 * 10/16 - 3/6 - 3/6, times the length of a kernel */
    assert_near(score.energy, 0.25 * sqrt(3), 1e-12);
    assert_close(score.scenes.items[0].true_targets, 0.75, 0);
    assert_close(score.scenes.items[0].listed_targets, 0.25, 0);
}

static double mean_gospa(const double *truth, const double *listed, int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++) {
        size_t item;
        double apart = fabs(truth[i] - listed[i]) / VIEW.cell_range_m;
        size_t pairs = gospa_pair(&apart, 1, 1, 2, &item, check_arena());
        sum += gospa_of(pairs > 0 ? apart * apart : 0, pairs, 1, 1, 2).value / count;
    }
    return sum;
}

/* Lists that never scatter have the smaller mean GOSPA from lists that do, though lists of the same
 * law as the truth are what is wanted. The energy distance is near 0 for those alone. */
TEST(gospa_favours_lists_without_scatter_and_energy_does_not)
{
    enum { SEEDS = 60 };
    uint64_t random = 11;
    double truth[SEEDS], same[SEEDS], still[SEEDS];
    struct stream streams[3];
    for (int i = 0; i < 3; i++)
        begin(&streams[i], 100 * (uint64_t)i);
    for (int i = 0; i < SEEDS; i++) {
        truth[i] = sample_between(&random, 18, 22);
        same[i] = sample_between(&random, 18, 22);
        still[i] = 20;
        add(&streams[0], &truth[i], 1);
        add(&streams[1], &same[i], 1);
        add(&streams[2], &still[i], 1);
    }
    assert_true(mean_gospa(truth, still, SEEDS) < 0.9 * mean_gospa(truth, same, SEEDS));
    struct ensemble_score equal = compare(&streams[0], &streams[1]);
    struct ensemble_score stiff = compare(&streams[0], &streams[2]);
    assert_true(equal.low < 0 && equal.high > 0);
    assert_true(stiff.low > equal.high);
}

/* Three seeds of two scenes: a true target at 20 m, and in each scene `count` listed ones at
 * range_m. */
static void begin_two_scenes(struct stream *truth, struct stream *listed, const double *range_m,
                             const size_t *count)
{
    begin(truth, 0), begin(listed, 100);
    for (int scene = 0; scene < 2; scene++)
        for (int seed = 0; seed < 3; seed++) {
            truth->frame.scene = listed->frame.scene = scene == 0 ? "s" : "t";
            add(truth, (double[]){20}, 1);
            add(listed, &range_m[scene], count[scene]);
        }
}

/* With several scenes the mean is over scenes, and resampling spreads from one to the other. */
TEST(the_interval_spans_the_scenes)
{
    struct stream truth, listed;
    begin_two_scenes(&truth, &listed, (double[]){20, 20}, (size_t[]){1, 0});
    struct ensemble_score score = compare(&truth, &listed);
    assert_int_equal(score.scenes.count, 2);
    assert_close(score.scenes.items[0].energy, 0, 0);
    assert_near(score.scenes.items[1].energy, 2 * sqrt(3), 1e-12);
    assert_near(score.energy, sqrt(3), 1e-12);
    assert_close(score.low, 0, 0);
    assert_near(score.high, 2 * sqrt(3), 1e-12);
}

/* A target is shifted by a cell in one scene and by two in the other: one resample in four has the
 * nearer scene alone, one the farther. */
TEST(the_interval_of_two_scenes_ends_at_their_energies)
{
    struct stream truth, listed;
    begin_two_scenes(&truth, &listed, (double[]){22, 24}, (size_t[]){1, 1});
    struct ensemble_score score = compare(&truth, &listed);
    assert_true(score.scenes.items[0].energy > 0.1);
    assert_true(score.scenes.items[1].energy > score.scenes.items[0].energy);
    assert_near(score.low, score.scenes.items[0].energy, 1e-12);
    assert_near(score.high, score.scenes.items[1].energy, 1e-12);
}

TEST(streams_that_do_not_match_are_refused)
{
    struct stream truth, listed;
    struct ensemble_score score;
    struct diag diag = {0};
    begin(&truth, 0), begin(&listed, 100);
    add(&truth, NULL, 0);
    assert_int_not_equal(ensemble_add(&truth.ensemble, &truth.frame, &diag), 0);
    assert_non_null(strstr(diag.text, "expected frames to ascend"));
    diag = (struct diag){0};
    add(&listed, NULL, 0);
    assert_int_not_equal(
        ensemble_compare(&truth.ensemble, &listed.ensemble, 0, check_arena(), &score, &diag), 0);
    assert_non_null(strstr(diag.text, "at least 3"));
    diag = (struct diag){0};
    add(&truth, NULL, 0), add(&truth, NULL, 0);
    add(&listed, NULL, 0);
    listed.frame.frame = 1;
    add(&listed, NULL, 0);
    assert_int_not_equal(
        ensemble_compare(&truth.ensemble, &listed.ensemble, 0, check_arena(), &score, &diag), 0);
    assert_non_null(strstr(diag.text, "other frames"));
    diag = (struct diag){0};
    listed.frame.scene = "t";
    add(&listed, NULL, 0);
    assert_int_not_equal(
        ensemble_compare(&truth.ensemble, &listed.ensemble, 0, check_arena(), &score, &diag), 0);
    assert_non_null(strstr(diag.text, "scenes: 2"));
}
