#include "check.h"
#include "frame/frame_check.h"
#include "frame/frame_order.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/units.h"
#include "documents/suite.h"
#include "run/runner.h"
#include "run/suite_choice.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

extern const struct stage stage_sensor, stage_noise, stage_noise_gauss;

/* One stage that works on frames made by hand. */
struct bench {
    struct runner runner;
    const struct suite *suite;
    struct frame frame;
    struct arena arena;
};

static void bench_open(struct bench *bench, const struct stage *stage, const char *suite)
{
    *bench = (struct bench){.frame = {.arena = NULL}};
    bench->frame.arena = &bench->arena;
    const char *words[] = {"--sensors", suite};
    assert_int_equal(runner_prepare(&bench->runner, stage, COUNT(words), words), 0);
    assert_int_equal(runner_start(&bench->runner), 0);
    bench->suite = suite_choice_load(&bench->runner, suite);
    if (bench->suite == NULL)
        fail_msg("%s", bench->runner.diag.text);
}

static void bench_close(struct bench *bench)
{
    runner_free(&bench->runner);
    arena_free(&bench->arena);
}

/* Empties the frame and puts into it what the bench's stage needs beside its input. */
static void bench_begin(struct bench *bench, int64_t number)
{
    struct frame *frame = &bench->frame;
    frame_clear(frame);
    frame->scene = "bench";
    frame->frame = number;
    frame->interval_s = 1;
    frame->seed = 1;
    frame->ego = "ego";
    frame->sections |= CARRY_ACCOUNT;
    frame->sensors.suite = bench->suite->name;
    frame->sensors.digest = bench->suite->digest;
    for (size_t i = 0; i < bench->suite->sensors.count; i++) {
        const char *name = bench->suite->sensors.items[i].name;
        *list_add(&frame->sensors.list, frame->arena) =
            (struct sensor_view){.name = name, .measured = true};
        *list_add(&frame->counts, frame->arena) = (struct count){.sensor = name};
    }
    frame->present = PART_SENSORS | PART_COUNTS | bench->runner.stage->reads;
}

static void bench_step(struct bench *bench)
{
    frame_order(&bench->frame);
    if (frame_check(&bench->frame, &bench->runner.diag) != 0 ||
        runner_step(&bench->runner, &bench->frame) != 0)
        fail_msg("%s", bench->runner.diag.text);
}

static void count_pair(struct frame *frame, const char *sensor)
{
    for (size_t i = 0; i < frame->counts.count; i++)
        if (strcmp(frame->counts.items[i].sensor, sensor) == 0)
            frame->counts.items[i].pairs++;
}

/* Adds a cell with one member; pointers and angle are the caller's. */
static struct cell *add_cell(struct frame *frame, const char *sensor, const char *object,
                             double range_m, double amplitude)
{
    struct cell *cell = list_add(&frame->cells, frame->arena);
    *cell = (struct cell){.sensor = sensor, .range_m = range_m, .amplitude = amplitude};
    cell->sum_re = amplitude;
    *list_add(&cell->members, frame->arena) = (struct contributor){
        .id.object = object, .id.reflector = "r", .range_m = range_m, .weight = 1};
    count_pair(frame, sensor);
    return cell;
}

static const struct target *target_of(const struct frame *frame, const char *sensor,
                                      const char *object)
{
    for (size_t i = 0; i < frame->targets.count; i++) {
        const struct target *target = &frame->targets.items[i];
        if (strcmp(target->sensor, sensor) == 0 &&
            strcmp(target->contributors.items[0].id.object, object) == 0)
            return target;
    }
    return NULL;
}

static double si(double u)
{
    return u == 0 ? 1 : sin(u) / u;
}

/* One point of a Monte Carlo: a reflector of strength G at an azimuth, seen by one of the pair's
 * sensors. */
struct point {
    const char *sensor, *object;
    double strength, azimuth_deg; /* G / sigma_H */
};

enum { DRAWS = 100000, POINTS = 8 };
enum { AT_10_16, AT_10_32, AT_30_16, AT_30_32, AT_0_16, AT_5_8, OTHER_SENSOR, OTHER_LEADER };

static const struct point points[POINTS] = {
    [AT_10_16] = {"left", "a", 16, 10},      [AT_10_32] = {"left", "b", 32, 10},
    [AT_30_16] = {"left", "c", 16, 30},      [AT_30_32] = {"left", "d", 32, 30},
    [AT_0_16] = {"left", "e", 16, 0},        [AT_5_8] = {"left", "f", 8, 5},
    [OTHER_SENSOR] = {"right", "c", 16, 30}, [OTHER_LEADER] = {"left", "g", 16, 30},
};

static const double cell_range_m = 12;
static const double cell_range_rate_mps = -3;

/* Equation (6), phases counted from the array's centre. */
static void add_point(struct frame *frame, const struct point *point, double sigma)
{
    double azimuth = point->azimuth_deg * PI / 180, u = PI / 2 * sin(azimuth);
    double height = point->strength * sigma * si(u) * cos(azimuth);
    struct cell *cell =
        add_cell(frame, point->sensor, point->object, cell_range_m, height * cos(u));
    cell->range_rate_mps = cell_range_rate_mps;
    cell->azimuth_rad = azimuth;
    cell->delta_im = -height * sin(u);
}

struct errors {
    double range_m[DRAWS], range_rate_mps[DRAWS], azimuth_rad[DRAWS];
};

struct sample {
    struct sensor sensor;
    struct errors *at; /* one for each of POINTS */
};

static struct sample *draw_sample(const struct stage *stage)
{
    struct sample *sample = malloc(sizeof *sample);
    sample->at = malloc(POINTS * sizeof *sample->at);
    struct bench bench;
    bench_open(&bench, stage, "srr24-pair");
    sample->sensor = bench.suite->sensors.items[0];
    for (int draw = 0; draw < DRAWS; draw++) {
        bench_begin(&bench, draw);
        for (int i = 0; i < POINTS; i++)
            add_point(&bench.frame, &points[i], sample->sensor.pointer_sigma);
        bench_step(&bench);
        for (int i = 0; i < POINTS; i++) {
            const struct target *target =
                target_of(&bench.frame, points[i].sensor, points[i].object);
            assert_non_null(target);
            sample->at[i].range_m[draw] = target->range_m - cell_range_m;
            sample->at[i].range_rate_mps[draw] = target->range_rate_mps - cell_range_rate_mps;
            sample->at[i].azimuth_rad[draw] = target->azimuth_rad - target->cell_azimuth_rad;
        }
    }
    bench_close(&bench);
    return sample;
}

static int draw_noise(void **state)
{
    *state = draw_sample(&stage_noise);
    return 0;
}

static int draw_noise_gauss(void **state)
{
    *state = draw_sample(&stage_noise_gauss);
    return 0;
}

static int free_sample(void **state)
{
    struct sample *sample = *state;
    free(sample->at);
    free(sample);
    return 0;
}

static double mean(const double *values)
{
    double sum = 0;
    for (int i = 0; i < DRAWS; i++)
        sum += values[i];
    return sum / DRAWS;
}

static double mean_product(const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < DRAWS; i++)
        sum += a[i] * b[i];
    return sum / DRAWS;
}

static double variance(const double *values)
{
    return mean_product(values, values) - mean(values) * mean(values);
}

static double correlation(const double *a, const double *b)
{
    double covariance = mean_product(a, b) - mean(a) * mean(b);
    return covariance / sqrt(variance(a) * variance(b));
}

/* The law of MODEL 7.3, first order and away from boresight, for G in units of sigma_H. */
static double azimuth_sigma_rad(const struct point *point)
{
    double azimuth = point->azimuth_deg * PI / 180, cosine = cos(azimuth);
    return sqrt(2) / PI / (point->strength * si(PI / 2 * sin(azimuth)) * cosine * cosine);
}

static const int off_boresight[] = {AT_10_16, AT_10_32, AT_30_16, AT_30_32};

FIXTURE(draw_noise, free_sample);

TEST(the_angle_scatters_as_the_first_order_formula_says)
{
    const struct sample *sample = *state;
    assert_close(sample->sensor.pointer_sigma, 0.5, 0);
    for (size_t i = 0; i < COUNT(off_boresight); i++) {
        int at = off_boresight[i];
        assert_near(sqrt(variance(sample->at[at].azimuth_rad)), azimuth_sigma_rad(&points[at]),
                    0.03);
    }
    assert_near(sqrt(variance(sample->at[AT_10_16].azimuth_rad)) * 180 / PI, 1.68, 0.03);
    assert_near(sqrt(variance(sample->at[AT_30_16].azimuth_rad)) * 180 / PI, 2.38, 0.03);
}

/* MODEL 7.3: at boresight |delta| is never negative, which makes the error sqrt(2) larger. */
TEST(the_angle_scatters_more_at_boresight)
{
    const struct sample *sample = *state;
    const double *error = sample->at[AT_0_16].azimuth_rad;
    assert_near(sqrt(mean_product(error, error)), 2 / PI / 16, 0.03);
    assert_close(mean(error), 0, 5 * 2 / PI / 16 / sqrt(DRAWS));
}

/* MODEL 7.3, its own Monte Carlo: G = 8 at 5 degrees has the wrong sign in 6.4 % of the draws. */
TEST(a_weak_echo_near_boresight_takes_the_wrong_side)
{
    const struct sample *sample = *state;
    double wrong = 0, azimuth_rad = 5 * PI / 180;
    for (int i = 0; i < DRAWS; i++)
        wrong += azimuth_rad + sample->at[AT_5_8].azimuth_rad[i] < 0;
    assert_close(wrong / DRAWS, 0.064, 0.004);
}

TEST(normalised_squared_errors_are_one)
{
    const struct sample *sample = *state;
    double range_sigma_m = sample->sensor.range_sigma_m;
    double range_rate_sigma_mps = sample->sensor.range_rate_sigma_mps;
    for (size_t i = 0; i < COUNT(off_boresight); i++) {
        const struct errors *error = &sample->at[off_boresight[i]];
        double sigma_rad = azimuth_sigma_rad(&points[off_boresight[i]]);
        assert_close(mean_product(error->range_m, error->range_m) / (range_sigma_m * range_sigma_m),
                     1, 0.03);
        assert_close(mean_product(error->range_rate_mps, error->range_rate_mps) /
                         (range_rate_sigma_mps * range_rate_sigma_mps),
                     1, 0.03);
        assert_close(mean_product(error->azimuth_rad, error->azimuth_rad) / (sigma_rad * sigma_rad),
                     1, 0.03);
    }
}

static void check_gaussian(const double *error, double sigma)
{
    assert_close(mean(error), 0, 5 * sigma / sqrt(DRAWS));
    assert_near(variance(error), sigma * sigma, 0.03);
    double beyond = 0;
    for (int i = 0; i < DRAWS; i++)
        beyond += fabs(error[i]) > 2 * sigma;
    assert_close(beyond / DRAWS, 0.0455, 0.004);
}

TEST(range_and_rate_are_gaussian)
{
    const struct sample *sample = *state;
    for (int i = 0; i < POINTS; i++) {
        check_gaussian(sample->at[i].range_m, sample->sensor.range_sigma_m);
        check_gaussian(sample->at[i].range_rate_mps, sample->sensor.range_rate_sigma_mps);
    }
}

TEST(errors_of_one_target_are_independent)
{
    const struct sample *sample = *state;
    for (int i = 0; i < POINTS; i++) {
        const struct errors *error = &sample->at[i];
        assert_close(correlation(error->range_m, error->azimuth_rad), 0, 0.02);
        assert_close(correlation(error->range_m, error->range_rate_mps), 0, 0.02);
        assert_close(correlation(error->range_rate_mps, error->azimuth_rad), 0, 0.02);
    }
}

static void check_unrelated(const double *a, const double *b)
{
    int equal = 0;
    for (int i = 0; i < DRAWS; i++)
        equal += a[i] == b[i];
    assert_true(equal <= 1);
    assert_close(correlation(a, b), 0, 0.02);
}

TEST(errors_of_other_sensors_and_leaders_are_independent)
{
    const struct sample *sample = *state;
    const struct errors *error = &sample->at[AT_30_16];
    for (int other = OTHER_SENSOR; other <= OTHER_LEADER; other++) {
        check_unrelated(error->range_m, sample->at[other].range_m);
        check_unrelated(error->range_rate_mps, sample->at[other].range_rate_mps);
        check_unrelated(error->azimuth_rad, sample->at[other].azimuth_rad);
    }
}

static void check_unrelated_in_time(const double *error)
{
    double product = 0;
    for (int i = 1; i < DRAWS; i++) {
        assert_true(error[i] != error[i - 1]);
        product += error[i] * error[i - 1];
    }
    assert_close(product / DRAWS / mean_product(error, error), 0, 0.02);
}

TEST(errors_of_other_frames_are_independent)
{
    const struct sample *sample = *state;
    check_unrelated_in_time(sample->at[AT_30_16].range_m);
    check_unrelated_in_time(sample->at[AT_30_16].range_rate_mps);
    check_unrelated_in_time(sample->at[AT_30_16].azimuth_rad);
}

FIXTURE(draw_noise_gauss, free_sample);

TEST(every_error_of_the_textbook_sensor_is_gaussian)
{
    const struct sample *sample = *state;
    range_and_rate_are_gaussian(state);
    for (int i = 0; i < POINTS; i++)
        check_gaussian(sample->at[i].azimuth_rad, sample->sensor.azimuth_sigma_rad);
}

TEST(errors_of_the_textbook_sensor_are_independent)
{
    errors_of_one_target_are_independent(state);
    errors_of_other_sensors_and_leaders_are_independent(state);
    errors_of_other_frames_are_independent(state);
}

/* Suites of one sensor "front" with a threshold of 1. */
struct scratch {
    char folder[40];
    char suite[60];
};

static int make_scratch(void **state)
{
    struct scratch *scratch = malloc(sizeof *scratch);
    strcpy(scratch->folder, "/tmp/glint-statistics-XXXXXX");
    if (mkdtemp(scratch->folder) == NULL)
        return -1;
    snprintf(scratch->suite, sizeof scratch->suite, "%s/suite.json", scratch->folder);
    *state = scratch;
    return 0;
}

static int free_scratch(void **state)
{
    struct scratch *scratch = *state;
    unlink(scratch->suite);
    rmdir(scratch->folder);
    free(scratch);
    return 0;
}

/* Members of a sensor without noise; with noise; and one that lists everything. */
#define QUIET                                                                                      \
    "\"pointer_sigma\": 0, \"range_sigma_m\": 0, \"range_rate_sigma_mps\": 0,"                     \
    "\"azimuth_sigma_rad\": 0"
#define NOISY                                                                                      \
    "\"pointer_sigma\": 0.5, \"range_sigma_m\": 0.3, \"range_rate_sigma_mps\": 0.7,"               \
    "\"azimuth_sigma_rad\": 0.1"
#define ALL "\"final_threshold\": false, \"list_order\": \"strongest\", \"list_limit\": 0"

static void open_suite(struct bench *bench, const struct stage *stage,
                       const struct scratch *scratch, const char *members)
{
    FILE *file = fopen(scratch->suite, "w");
    assert_non_null(file);
    fprintf(file,
            "{\"origin\": \"a test\", \"sensors\": [{\"name\": \"front\", \"mount_x_m\": 0, "
            "\"mount_y_m\": 0, \"mount_yaw_rad\": 0, \"carrier_hz\": 24e9, \"range_min_m\": 0.2, "
            "\"range_max_m\": 100, \"field_of_view_rad\": 3, \"threshold_db\": 0, "
            "\"calibration_ercs\": 1, \"calibration_range_m\": 30, \"cell_range_m\": 0.3, "
            "\"cell_range_rate_mps\": 0.5, \"antenna_pattern\": \"dipole_pair\", "
            "\"angle_estimator\": \"magnitude\", %s}]}",
            members);
    assert_int_equal(fclose(file), 0);
    bench_open(bench, stage, scratch->suite);
}

#define CENTRE ", \"phase_reference\": \"centre\""

struct listed {
    const char *object;
    double amplitude, range_m, range_rate_mps, azimuth_rad;
};

/* Adds a cell whose leader has other ideal values than the cell; the leader's do not break ties. */
static void add_listed(struct frame *frame, const struct listed *listed)
{
    struct cell *cell =
        add_cell(frame, "front", listed->object, listed->range_m, listed->amplitude);
    cell->members.items[0].range_rate_mps = listed->range_rate_mps;
    cell->members.items[0].azimuth_rad = listed->azimuth_rad;
}

static const struct listed ties[] = {
    {"p", 8, 20, 0, 0},   {"a", 8, 20, 0, 0}, {"b", 8, 20, 0, -0.1}, {"c", 8, 20, -1, 0.2},
    {"d", 8, 10, 3, 0.3}, {"e", 9, 50, 0, 0}, {"f", 5, 10, 0, 0},    {"g", 2, 5, 0, 0},
};

static void check_list(const struct scratch *scratch, const char *members, const char *order)
{
    struct bench bench;
    open_suite(&bench, &stage_noise, scratch, members);
    bench_begin(&bench, 0);
    for (size_t i = 0; i < COUNT(ties); i++)
        add_listed(&bench.frame, &ties[i]);
    bench_step(&bench);
    assert_int_equal(bench.frame.targets.count, strlen(order));
    for (size_t i = 0; order[i] != '\0'; i++)
        assert_int_equal(bench.frame.targets.items[i].contributors.items[0].id.object[0], order[i]);
    bench_close(&bench);
}

FIXTURE(make_scratch, free_scratch);

TEST(the_list_is_ordered_by_strength_or_range_and_ties_by_the_leader)
{
    const char *strongest = QUIET CENTRE ", \"final_threshold\": true, "
                                         "\"list_order\": \"strongest\", \"list_limit\": 0";
    const char *nearest = QUIET CENTRE ", \"final_threshold\": true, "
                                       "\"list_order\": \"nearest\", \"list_limit\": 0";
    check_list(*state, strongest, "edcbapfg");
    check_list(*state, nearest, "gdfcbape");
}

static const struct lost_group *only_loss(const struct frame *frame)
{
    assert_int_equal(frame->lost.count, 1);
    assert_string_equal(frame->lost.items[0].sensor, "front");
    assert_string_equal(frame->lost.items[0].stage, "noise");
    return &frame->lost.items[0];
}

TEST(what_is_beyond_the_list_limit_is_lost)
{
    struct bench bench;
    open_suite(&bench, &stage_noise, *state,
               QUIET CENTRE ", \"final_threshold\": true, \"list_order\": \"strongest\", "
                            "\"list_limit\": 6");
    bench_begin(&bench, 0);
    for (size_t i = 0; i < COUNT(ties); i++)
        add_listed(&bench.frame, &ties[i]);
    bench_step(&bench);
    assert_int_equal(bench.frame.targets.count, 6);
    const struct lost_group *group = only_loss(&bench.frame);
    assert_int_equal(frame_loss_of(group->reason), LOSS_LIST_LIMIT);
    assert_int_equal(group->echoes.count, 2);
    assert_string_equal(group->echoes.items[0].id.object, "f");
    assert_string_equal(group->echoes.items[1].id.object, "g");
    bench_close(&bench);
}

TEST(the_final_threshold_takes_what_cancels)
{
    struct bench bench;
    open_suite(&bench, &stage_noise, *state,
               QUIET CENTRE ", \"final_threshold\": true, \"list_order\": \"strongest\", "
                            "\"list_limit\": 0");
    bench_begin(&bench, 0);
    add_cell(&bench.frame, "front", "at", 10, 3)->sum_re = 1;
    struct cell *cell = add_cell(&bench.frame, "front", "below", 10, 3);
    cell->sum_re = 0;
    cell->sum_im = -0.5;
    cell->members.items[0].weight = 0.75;
    *list_add(&cell->members, bench.frame.arena) =
        (struct contributor){.id.object = "second", .id.reflector = "r", .weight = 0.25};
    count_pair(&bench.frame, "front");
    bench_step(&bench);
    assert_int_equal(bench.frame.targets.count, 1);
    assert_string_equal(bench.frame.targets.items[0].contributors.items[0].id.object, "at");
    const struct lost_group *group = only_loss(&bench.frame);
    assert_int_equal(frame_loss_of(group->reason), LOSS_BELOW_FINAL);
    assert_int_equal(group->echoes.count, 2);
    assert_string_equal(group->echoes.items[0].id.object, "below");
    assert_string_equal(group->echoes.items[1].id.object, "second");
    assert_close(group->echoes.items[0].shortfall_db, 6.020599913279624, 1e-12);
    assert_close(group->echoes.items[1].shortfall_db, 6.020599913279624, 1e-12);
    bench_close(&bench);
}

TEST(without_a_final_threshold_all_that_has_an_angle_stays)
{
    struct bench bench;
    open_suite(&bench, &stage_noise, *state, QUIET CENTRE ", " ALL);
    bench_begin(&bench, 0);
    add_cell(&bench.frame, "front", "faint", 10, 3)->sum_re = 1e-3;
    add_cell(&bench.frame, "front", "none", 10, 3)->sum_re = 0;
    bench_step(&bench);
    assert_int_equal(bench.frame.targets.count, 1);
    assert_close(bench.frame.targets.items[0].amplitude_db, -60, 1e-12);
    assert_int_equal(frame_loss_of(only_loss(&bench.frame)->reason), LOSS_NO_ANGLE);
    bench_close(&bench);
}

/* Errors of the same draws under another suite, for one cell of amplitude 4 and one of 1, over many
 * frames. */
struct pair {
    double range_m[2], range_rate_mps[2], azimuth_rad[2];
};

enum { PAIRS = 200 };

static void draw_pairs(const struct scratch *scratch, const char *members, struct pair *pairs)
{
    struct bench bench;
    open_suite(&bench, &stage_noise, scratch, members);
    for (int i = 0; i < PAIRS; i++) {
        bench_begin(&bench, i);
        add_cell(&bench.frame, "front", "strong", 40, 4);
        add_cell(&bench.frame, "front", "weak", 30, 1);
        bench_step(&bench);
        for (int j = 0; j < 2; j++) {
            const struct target *target =
                target_of(&bench.frame, "front", j == 0 ? "strong" : "weak");
            assert_non_null(target);
            pairs[i].range_m[j] = target->range_m;
            pairs[i].range_rate_mps[j] = target->range_rate_mps;
            pairs[i].azimuth_rad[j] = target->azimuth_rad;
        }
    }
    bench_close(&bench);
}

static void check_step(double stepped, double exact, double step)
{
    assert_close(stepped / step, round(stepped / step), 1e-9);
    assert_close(stepped, exact, step / 2 * (1 + 1e-9));
}

TEST(reported_values_are_the_nearest_multiples_of_the_steps)
{
    struct pair exact[PAIRS], stepped[PAIRS];
    draw_pairs(*state, NOISY CENTRE ", " ALL, exact);
    draw_pairs(*state,
               NOISY CENTRE ", " ALL ", \"range_step_m\": 0.01, \"range_rate_step_mps\": 0.1, "
                            "\"azimuth_step_rad\": 0.017453292519943295",
               stepped);
    for (int i = 0; i < PAIRS; i++)
        for (int j = 0; j < 2; j++) {
            check_step(stepped[i].range_m[j], exact[i].range_m[j], 0.01);
            check_step(stepped[i].range_rate_mps[j], exact[i].range_rate_mps[j], 0.1);
            check_step(stepped[i].azimuth_rad[j], exact[i].azimuth_rad[j], PI / 180);
        }
}

TEST(by_amplitude_the_strong_scatter_less)
{
    static const double part[] = {1.0 / 4, 1};
    static const double range_m[] = {40, 30};
    struct pair fixed[PAIRS], by_amplitude[PAIRS];
    draw_pairs(*state, NOISY CENTRE ", " ALL ", \"sigma_law\": \"fixed\"", fixed);
    draw_pairs(*state, NOISY CENTRE ", " ALL ", \"sigma_law\": \"by_amplitude\"", by_amplitude);
    for (int i = 0; i < PAIRS; i++)
        for (int j = 0; j < 2; j++) {
            assert_close(by_amplitude[i].range_m[j] - range_m[j],
                         part[j] * (fixed[i].range_m[j] - range_m[j]), 1e-12);
            assert_close(by_amplitude[i].range_rate_mps[j], part[j] * fixed[i].range_rate_mps[j],
                         1e-12);
            assert_close(by_amplitude[i].azimuth_rad[j], fixed[i].azimuth_rad[j], 0);
        }
}

/* One cell and the same cell with one name changed: all draws must differ. */
struct address {
    const char *scene, *object, *reflector;
    int64_t frame;
    uint64_t seed;
};

static struct pair draw_at(struct bench *bench, const struct address *address)
{
    bench_begin(bench, address->frame);
    bench->frame.scene = address->scene;
    bench->frame.seed = address->seed;
    struct cell *cell = add_cell(&bench->frame, "front", address->object, 40, 4);
    cell->members.items[0].id.reflector = address->reflector;
    bench_step(bench);
    const struct target *target = target_of(&bench->frame, "front", address->object);
    assert_non_null(target);
    return (struct pair){{target->range_m}, {target->range_rate_mps}, {target->azimuth_rad}};
}

TEST(draws_depend_on_every_part_of_their_address)
{
    static const struct address addresses[] = {
        {"s", "o", "r", 3, 1},
        {"s2", "o", "r", 3, 1},
        {"s", "o2", "r", 3, 1},
        {"s", "o", "r2", 3, 1},
        {"s", "o", "r", 4, 1},
        {"s", "o", "r", 3, 2},
        {"s", "o", "r", 3, UINT64_C(1) << 63 | 1},
    };
    struct pair drawn[COUNT(addresses)];
    struct bench bench;
    open_suite(&bench, &stage_noise, *state, NOISY CENTRE ", " ALL);
    for (size_t i = 0; i < COUNT(addresses); i++)
        drawn[i] = draw_at(&bench, &addresses[i]);
    struct pair again = draw_at(&bench, &addresses[0]);
    assert_memory_equal(&again, &drawn[0], sizeof again);
    for (size_t i = 0; i < COUNT(addresses); i++)
        for (size_t j = 0; j < i; j++) {
            assert_true(drawn[i].range_m[0] != drawn[j].range_m[0]);
            assert_true(drawn[i].range_rate_mps[0] != drawn[j].range_rate_mps[0]);
            assert_true(drawn[i].azimuth_rad[0] != drawn[j].azimuth_rad[0]);
        }
    bench_close(&bench);
}

static void add_echo(struct frame *frame, const char *object, double range_m, double azimuth_deg,
                     double ercs)
{
    *list_add(&frame->echoes, frame->arena) = (struct echo){
        .sensor = "front",
        .id.object = object,
        .id.reflector = "r",
        .range_m = range_m,
        .azimuth_rad = azimuth_deg * PI / 180,
        .ercs = ercs,
    };
}

/* MODEL 8.1. Under "element", equal strengths at opposite angles have a real ratio: no sign. */
TEST(two_reflectors_in_one_cell_make_one_target_between_them)
{
    static const struct {
        const char *reference;
        double left_deg, right_deg, ratio, azimuth_deg, tolerance_deg;
        bool sign_undecided;
    } cases[] = {
        {"centre", 8, -8, 1, 0, 1e-6, true},       {"centre", 8, -8, 2, 2.70, 0.005, false},
        {"centre", 8, -8, 5, 5.37, 0.005, false},  {"centre", 15, -5, 1, 4.64, 0.005, false},
        {"element", 8, -8, 1, 1.80, 0.005, true},  {"element", 8, -8, 2, 3.23, 0.005, false},
        {"element", 8, -8, 5, 5.60, 0.005, false}, {"element", 15, -5, 1, 5.40, 0.005, false},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        char members[400];
        snprintf(members, sizeof members, "%s, %s, \"phase_reference\": \"%s\"", QUIET, ALL,
                 cases[i].reference);
        struct bench bench;
        open_suite(&bench, &stage_sensor, *state, members);
        bench_begin(&bench, 0);
        add_echo(&bench.frame, "left", 10, cases[i].left_deg, cases[i].ratio);
        add_echo(&bench.frame, "right", 10, cases[i].right_deg, 1);
        bench_step(&bench);
        assert_int_equal(bench.frame.cells.count, 1);
        const struct cell *cell = &bench.frame.cells.items[0];
        assert_close(cell->azimuth_rad * 180 / PI, cases[i].azimuth_deg, cases[i].tolerance_deg);
        assert_int_equal(cell->sign_undecided, cases[i].sign_undecided);
        bench_close(&bench);
    }
}

enum { PHASE_DRAWS = 20000 };

static int compare_reals(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

static void draw_cell(struct bench *bench, int number)
{
    bench_begin(bench, number);
    add_echo(&bench->frame, "left", 10, 8, 1);
    add_echo(&bench->frame, "right", 10, -8, 1);
    add_echo(&bench->frame, "single", 20, 20, 1);
    bench_step(bench);
    assert_int_equal(bench->frame.cells.count, 2);
    assert_int_equal(bench->frame.cells.items[0].members.count, 2);
}

/* MODEL 8.2: with a random phase between two equal reflectors at 8 degrees to both sides, the
 * ratio of the channels is tan u tan(phase / 2). */
TEST(random_phases_spread_the_angle_as_their_closed_form_says)
{
    static const double quantiles[] = {0.1, 0.25, 0.5, 0.75, 0.9};
    double *azimuth_rad = malloc(PHASE_DRAWS * sizeof *azimuth_rad);
    double tangent = tan(PI / 2 * sin(8 * PI / 180));
    struct bench bench;
    open_suite(&bench, &stage_sensor, *state, QUIET CENTRE ", " ALL ", \"cell_phase\": \"random\"");
    for (int i = 0; i < PHASE_DRAWS; i++) {
        draw_cell(&bench, i);
        azimuth_rad[i] = fabs(bench.frame.cells.items[0].azimuth_rad);
    }
    bench_close(&bench);
    qsort(azimuth_rad, PHASE_DRAWS, sizeof *azimuth_rad, compare_reals);
    for (size_t i = 0; i < COUNT(quantiles); i++) {
        double ratio = tangent * tan(quantiles[i] * PI / 2);
        assert_near(azimuth_rad[(int)(quantiles[i] * PHASE_DRAWS)], asin(2 / PI * atan(ratio)),
                    0.05);
    }
    assert_near(azimuth_rad[PHASE_DRAWS / 2], 8 * PI / 180, 0.03);
    free(azimuth_rad);
}

TEST(a_random_phase_turns_pointers_and_leaves_membership)
{
    struct bench in_phase, random;
    open_suite(&in_phase, &stage_sensor, *state, QUIET CENTRE ", " ALL);
    open_suite(&random, &stage_sensor, *state,
               QUIET CENTRE ", " ALL ", \"cell_phase\": \"random\"");
    for (int i = 0; i < 50; i++) {
        draw_cell(&in_phase, i);
        draw_cell(&random, i);
        for (size_t j = 0; j < 2; j++) {
            const struct cell *one = &in_phase.frame.cells.items[j];
            const struct cell *other = &random.frame.cells.items[j];
            assert_int_equal(one->members.count, other->members.count);
            for (size_t k = 0; k < one->members.count; k++) {
                assert_string_equal(one->members.items[k].id.object,
                                    other->members.items[k].id.object);
                assert_close(one->members.items[k].weight, other->members.items[k].weight, 0);
            }
            assert_close(one->amplitude, other->amplitude, 0);
            assert_close(one->range_m, other->range_m, 0);
            assert_true(hypot(other->sum_re, other->sum_im) <= one->amplitude * (1 + 1e-15));
        }
        const struct cell *alone = &in_phase.frame.cells.items[1];
        const struct cell *single = &random.frame.cells.items[1];
        assert_close(single->sum_re, alone->sum_re, 0);
        assert_close(single->sum_im, alone->sum_im, 0);
        assert_close(single->azimuth_rad, 20 * PI / 180, 1e-14);
        assert_true(random.frame.cells.items[0].effects & EFFECT_BIT(EFFECT_COHERENCE));
        assert_false(single->effects & EFFECT_BIT(EFFECT_COHERENCE));
    }
    bench_close(&in_phase);
    bench_close(&random);
}

/* An echo an eighth of a wavelength farther away lags the leader by a quarter of a turn, in
 * whatever frame and wherever both are; reflectors start from phases of their own. */
TEST(phases_by_path_follow_the_range)
{
    const double wave_m = 299792458 / 24e9;
    struct bench bench;
    open_suite(&bench, &stage_sensor, *state,
               QUIET CENTRE ", " ALL ", \"cell_phase\": \"by_path\"");
    double first_rad = 0;
    for (int i = 0; i < 40; i++) {
        double place_m = 20 + i % 3;
        bench_begin(&bench, i);
        add_echo(&bench.frame, "a", place_m, 0, 4);
        add_echo(&bench.frame, "b", place_m + i % 16 * wave_m / 8, 0, 1);
        bench_step(&bench);
        assert_int_equal(bench.frame.cells.count, 1);
        const struct cell *cell = &bench.frame.cells.items[0];
        double leader = cell->amplitude * cell->members.items[0].weight;
        double phase_rad = atan2(cell->sum_im, cell->sum_re - leader);
        if (i == 0)
            first_rad = phase_rad;
        assert_close(remainder(phase_rad - first_rad + i % 16 * PI / 2, 2 * PI), 0, 1e-10);
        assert_near(hypot(cell->sum_re - leader, cell->sum_im), cell->amplitude - leader, 1e-13);
    }
    assert_true(fabs(remainder(first_rad, 2 * PI)) > 1e-3);
    bench_close(&bench);
}
