/* Sums and weights: hard cases 14 to 21. Case 13 is in pointers.c; 18 has no place in glint, which
 * computes no variance. */
#include "hard.h"

#include <float.h>

#include "base/hash.h"
#include "base/number.h"
#include "base/sort.h"
#include "base/units.h"
#include "noise/target_list.h"
#include "radar/resolution.h"
#include "sensor/resolution_cell.h"
#include "text/record_write.h"

enum { MOST = 10, PRECISION = 320 };

struct members {
    double value[MOST], weight[MOST];
    size_t count;
};

/* Draws two to ten values within half_span of a leader, with weights falling from at most 1. */
static struct members draw_members(uint64_t *random, double low, double high, double half_span)
{
    struct members drawn = {.count = 2 + (size_t)(sample_bits(random) % (MOST - 1))};
    double leader = sample_between(random, low, high), weight = 1;
    for (size_t i = 0; i < drawn.count; i++) {
        drawn.value[i] = i == 0 ? leader : leader + sample_between(random, -half_span, half_span);
        drawn.weight[i] = weight *= sample_between(random, 0.3, 1);
    }
    return drawn;
}

static double plain_mean(const struct members *of)
{
    double total = 0, mean = 0;
    for (size_t i = 0; i < of->count; i++)
        total += of->weight[i];
    for (size_t i = 0; i < of->count; i++)
        mean += of->value[i] * (of->weight[i] / total);
    return mean;
}

static double our_mean(const struct members *of)
{
    return resolution_mean(of->value, of->weight, of->count);
}

static void exact_mean(const struct members *of, mpfr_t mean)
{
    MPFR_DECL_INIT(term, PRECISION);
    MPFR_DECL_INIT(total, PRECISION);
    mpfr_set_zero(total, 1);
    mpfr_set_zero(mean, 1);
    for (size_t i = 0; i < of->count; i++) {
        mpfr_set_d(term, of->weight[i], MPFR_RNDN);
        mpfr_add(total, total, term, MPFR_RNDN);
        mpfr_mul_d(term, term, of->value[i], MPFR_RNDN);
        mpfr_add(mean, mean, term, MPFR_RNDN);
    }
    mpfr_div(mean, mean, total, MPFR_RNDN);
}

TEST(echoes_at_one_range_stay_there)
{
    uint64_t random = 15;
    int points = hard_points(2000000);
    double naive = 0, ours = 0;
    for (int i = 0; i < points; i++) {
        struct members of = draw_members(&random, 0.2, 200, 0);
        naive += plain_mean(&of) != of.value[0];
        ours += our_mean(&of) != of.value[0];
    }
    hard_case("15", "mean of equal ranges leaves their value", "wrong", naive, ours, 0);
}

static int is_outside(double mean, const struct members *of)
{
    double least = of->value[0], most = of->value[0];
    for (size_t i = 1; i < of->count; i++) {
        least = fmin(least, of->value[i]);
        most = fmax(most, of->value[i]);
    }
    return !(mean >= least && mean <= most);
}

/* Draws values a few ulp apart, where rounding can carry a mean out of their span. */
static struct members draw_neighbours(uint64_t *random)
{
    struct members of = draw_members(random, 0.2, 200, 0);
    for (size_t i = 1; i < of.count; i++)
        of.value[i] += (double)sample_integer(random, 3) * DBL_EPSILON * of.value[0];
    return of;
}

/* Puts nearly all weight on the farthest value, whose distance is rounded. */
static struct members draw_at_the_end(uint64_t *random)
{
    struct members of = draw_members(random, -1, 1, 0);
    double end = sample_between(random, -1, 1);
    for (size_t i = 1; i < of.count; i++)
        of.value[i] = end;
    of.weight[0] *= 1e-18;
    return of;
}

TEST(a_mean_stays_between_its_values)
{
    uint64_t random = 16;
    int points = hard_points(300000);
    double naive = 0, ours = 0;
    for (int i = 0; i < points; i++) {
        struct members of = i % 3 == 0   ? draw_members(&random, 0.2, 200, 0.15)
                            : i % 3 == 1 ? draw_neighbours(&random)
                                         : draw_at_the_end(&random);
        naive += is_outside(plain_mean(&of), &of);
        ours += is_outside(our_mean(&of), &of);
    }
    hard_case("16", "mean outside its values", "wrong", naive, ours, 0);
}

TEST(a_mean_range_is_within_an_ulp)
{
    uint64_t random = 161;
    int points = hard_points(300000);
    double naive = 0, ours = 0;
    MPFR_DECL_INIT(exact, PRECISION);
    for (int i = 0; i < points; i++) {
        struct members of = draw_members(&random, 0.5, 200, 0.15);
        exact_mean(&of, exact);
        naive = fmax(naive, error_ulp(plain_mean(&of), exact));
        exact_mean(&of, exact);
        ours = fmax(ours, error_ulp(our_mean(&of), exact));
    }
    hard_case("16", "mean range", "ulp", naive, ours, 1);
}

/* Hard case 16 for rates: a mean may cancel to nearly nothing, where an ulp of it means nothing, so
 * the error is in m/s. */
TEST(a_mean_rate_near_zero_is_as_exact_as_its_members)
{
    uint64_t random = 162;
    int points = hard_points(300000);
    double naive = 0, ours = 0;
    MPFR_DECL_INIT(exact, PRECISION);
    for (int i = 0; i < points; i++) {
        struct members of = draw_members(&random, -0.25, 0.25, 0.25);
        exact_mean(&of, exact);
        naive = fmax(naive, error_size(plain_mean(&of), exact));
        ours = fmax(ours, error_size(our_mean(&of), exact));
    }
    hard_case("16", "mean rate near zero", "m/s", naive, ours, 0x1p-52);
}

static const struct sensor plain_sensor = {.name = "s", .threshold = 1};

static struct received_echo ray_of(const char *reflector, double range_m, double rate_mps,
                                   double amplitude)
{
    return (struct received_echo){.echo = {.id.object = "o",
                                           .id.reflector = reflector,
                                           .range_m = range_m,
                                           .range_rate_mps = rate_mps},
                                  .range_m = range_m,
                                  .range_rate_mps = rate_mps,
                                  .strength = amplitude,
                                  .amplitude = amplitude};
}

static void shuffle(uint64_t *random, struct received_echo *received_echoes, size_t count)
{
    for (size_t i = count - 1; i > 0; i--) {
        size_t k = (size_t)(sample_bits(random) % (i + 1));
        struct received_echo received = received_echoes[i];
        received_echoes[i] = received_echoes[k];
        received_echoes[k] = received;
    }
}

static int compare_doubles(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

static double count_distinct(double *values, size_t count)
{
    qsort(values, count, sizeof *values, compare_doubles);
    double distinct = 1;
    for (size_t i = 1; i < count; i++)
        distinct += values[i] != values[i - 1];
    return distinct;
}

/* All numbers of the cell folded into one, which equal cells share. */
static double fingerprint(const struct cell *cell)
{
    double numbers[] = {cell->range_m, cell->range_rate_mps, cell->amplitude, cell->sum_re,
                        cell->sum_im,  cell->delta_re,       cell->delta_im,  cell->azimuth_rad};
    return (double)(hash_bytes(HASH_START, numbers, sizeof numbers) >> 11);
}

TEST(a_cell_is_the_same_for_every_order_of_its_echoes)
{
    enum { ECHOES = 1000, ORDERS = 1000 };
    static const char *const names[] = {"a", "b", "c", "d"};
    uint64_t random = 14;
    struct arena *arena = check_arena();
    struct received_echo *received_echoes = malloc(ECHOES * sizeof *received_echoes);
    double *plain = malloc(2 * ORDERS * sizeof *plain), *ours = plain + ORDERS;
    assert_true(received_echoes != NULL && plain != NULL);
    for (size_t i = 0; i < ECHOES; i++) {
        double amplitude = floor(sample_between(&random, 1, 50)) / 10;
        double range_m = sample_between(&random, 30, 30.3);
        double rate_mps = sample_between(&random, -0.25, 0.25);
        received_echoes[i] = ray_of(names[i % 4], range_m, rate_mps, amplitude);
        received_echoes[i].echo.azimuth_rad = sample_between(&random, -1, 1);
        received_echoes[i].phase_rad = sample_between(&random, 0, 6.28);
    }
    size_t orders = (size_t)hard_points(ORDERS);
    for (size_t k = 0; k < orders; k++) {
        struct cell cell;
        shuffle(&random, received_echoes, ECHOES);
        plain[k] = 0;
        for (size_t i = 0; i < ECHOES; i++)
            plain[k] += received_echoes[i].amplitude * received_echoes[i].echo.range_m;
        sort_items(received_echoes, ECHOES, sizeof *received_echoes, resolution_cell_compare,
                   arena);
        resolution_cell_of(&plain_sensor, received_echoes, ECHOES, true, arena, &cell);
        ours[k] = fingerprint(&cell);
        arena_clear(arena);
    }
    hard_case("14", "cell of 1,000 echoes in 1,000 orders", "results",
              count_distinct(plain, orders), count_distinct(ours, orders), 1);
    free(plain);
    free(received_echoes);
}

/* Hard case 17: amplitudes from 1e-300 to 1e300, ten decades between the members of a cell. */
TEST(cells_of_any_amplitude_are_finite_and_exact)
{
    uint64_t random = 17;
    int points = hard_points(100000);
    double naive = 0, ours = 0;
    for (int i = 0; i < points; i++) {
        double decades = sample_between(&random, -290, 299), powers = 0, power_mean = 0;
        struct received_echo received_echoes[4];
        struct cell cell;
        for (size_t k = 0; k < 4; k++) {
            double amplitude = pow(10, decades - 2.5 * (double)k);
            received_echoes[k] = ray_of("r", 30 + 0.05 * (double)k, 0.1 * (double)k, amplitude);
            powers += amplitude * amplitude;
            power_mean += amplitude * amplitude * received_echoes[k].echo.range_m;
        }
        naive += !isfinite(power_mean / powers);
        resolution_cell_of(&plain_sensor, received_echoes, 4, true, check_arena(), &cell);
        double share = 1 + pow(10, -2.5) + pow(10, -5) + pow(10, -7.5);
        double expected_m =
            30 + 0.05 * (pow(10, -2.5) + 2 * pow(10, -5) + 3 * pow(10, -7.5)) / share;
        ours += !isfinite(cell.amplitude) || !isfinite(cell.range_rate_mps) ||
                !(fabs(cell.range_m - expected_m) < 1e-12) ||
                !(fabs(cell.members.items[0].weight - 1 / share) < 1e-12);
        arena_clear(check_arena());
    }
    hard_case("17", "amplitudes of 1e-300 to 1e300 (naive: powers)", "wrong", naive, ours, 0);
}

TEST(an_amplitude_beyond_the_doubles_is_refused)
{
    struct arena *arena = check_arena();
    struct frame frame = {.arena = arena,
                          .scene = "s",
                          .ego = "e",
                          .interval_s = 1,
                          .present = PART_OBJECTS | PART_CELLS};
    const struct received_echo received_echoes[] = {ray_of("a", 10, 0, 1.2e308),
                                                    ray_of("b", 10, 0, 1.2e308)};
    struct diag alone = {0}, both = {0};
    struct cell *cell = list_add(&frame.cells, arena);
    resolution_cell_of(&plain_sensor, received_echoes, 1, true, arena, cell);
    cell->amplitude = cell->sum_re = 1e307;
    record_write_check(&frame_record, &frame, ~0U, &alone);
    resolution_cell_of(&plain_sensor, received_echoes, 2, true, arena, cell);
    record_write_check(&frame_record, &frame, ~0U, &both);
    hard_case("17", "amplitude sum of 2.4e308 passes unreported", "wrong", 1,
              (alone.code != DIAG_OK) + (both.code == DIAG_OK) +
                  (strncmp(both.text, "cells[0].amplitude: inf", 23) != 0),
              0);
}

static double any_amplitude(uint64_t *random)
{
    double digits = sample_between(random, 1, 10);
    return digits * pow(10, (double)sample_integer(random, 300));
}

TEST(amplitudes_cross_the_pipe_unchanged)
{
    uint64_t random = 19;
    int points = hard_points(200000);
    double naive = 0, ours = 0;
    MPFR_DECL_INIT(exact, PRECISION);
    for (int i = 0; i < points; i++) {
        double amplitude = any_amplitude(&random), back;
        char text[NUMBER_SIZE];
        mpfr_set_d(exact, amplitude, MPFR_RNDN);
        naive = fmax(naive, error_ulp(pow(10, 20 * log10(amplitude) / 20), exact));
        assert_true(number_read(text, text + number_write(amplitude, text), &back));
        ours = fmax(ours, error_ulp(back, exact));
    }
    hard_case("19", "amplitude through the pipe (naive: in dB)", "ulp", naive, ours, 0);
}

TEST(decibels_in_targets_are_within_two_ulp)
{
    uint64_t random = 191;
    int points = hard_points(200000);
    double naive = 0, ours = 0;
    MPFR_DECL_INIT(exact, PRECISION);
    for (int i = 0; i < points; i++) {
        double amplitude = any_amplitude(&random);
        mpfr_set_d(exact, amplitude, MPFR_RNDN);
        mpfr_log10(exact, exact, MPFR_RNDN);
        mpfr_mul_ui(exact, exact, 20, MPFR_RNDN);
        naive = fmax(naive, error_ulp(20 / log(10) * log(amplitude), exact));
        ours = fmax(ours, error_ulp(units_amplitude_db(amplitude), exact));
    }
    hard_case("19", "amplitude_db of a target (naive: by ln)", "ulp", naive, ours, 2);
}

/* Hard case 20, by the chain's own decision: a cell is dropped if its amplitude < threshold, both
 * linear. */
static int is_dropped(const struct sensor *sensor, double amplitude)
{
    struct received_echo received = ray_of("r", 10, 0, amplitude);
    struct cell cell;
    resolution_cell_of(sensor, &received, 1, true, check_arena(), &cell);
    return cell.amplitude < sensor->threshold;
}

TEST(an_amplitude_at_the_threshold_is_detected)
{
    double naive = 0, ours = 0;
    for (int i = -500; i < 500; i++) {
        struct sensor sensor = {.name = "s",
                                .carrier_hz = 77e9,
                                .threshold_db = i / 10.0,
                                .calibration_ercs = 1,
                                .calibration_range_m = 10};
        suite_derive(&sensor);
        double below = nextafter(sensor.threshold, 0);
        naive += 20 * log10(pow(10, sensor.threshold_db / 20)) < sensor.threshold_db;
        ours += is_dropped(&sensor, sensor.threshold) || !is_dropped(&sensor, below) ||
                units_shortfall_db(sensor.threshold, sensor.threshold) != 0 ||
                !(units_shortfall_db(sensor.threshold, below) >= 0);
    }
    hard_case("20", "amplitude exactly at 1,000 thresholds", "wrong", naive, ours, 0);
}

static void list_readings(struct frame *frame, const double *amplitudes, size_t count)
{
    const struct sensor sensor = {.name = "s"};
    struct cell *cells = arena_get(frame->arena, count * sizeof *cells);
    struct effect_measurement *measurements = arena_get(frame->arena, count * sizeof *measurements);
    for (size_t i = 0; i < count; i++) {
        cells[i] = (struct cell){.sensor = "s", .sum_re = amplitudes[i]};
        *list_add(&cells[i].members, frame->arena) =
            (struct contributor){.id.object = "o", .id.reflector = "r", .weight = 1};
        measurements[i] = effect_measurement_of(NULL, &cells[i]);
    }
    const struct detection_source source = {.sensor = &sensor};
    target_list_make(frame, "noise", &source, measurements, count);
}

TEST(no_amplitude_makes_infinite_decibels)
{
    uint64_t random = 21;
    int points = hard_points(100000);
    double naive = 0, ours = 0;
    for (int i = 0; i < points; i += 5) {
        struct frame frame = {.arena = check_arena(), .sections = CARRY_ACCOUNT};
        double amplitudes[] = {0, 5e-324, -0.0, DBL_MAX, any_amplitude(&random)};
        for (size_t k = 0; k < 5; k++) {
            naive += !isfinite(20 * log10(amplitudes[k]));
            ours += !isfinite(units_shortfall_db(1, fabs(amplitudes[k])));
        }
        list_readings(&frame, amplitudes, 5);
        ours += frame.targets.count != 3 || frame.lost.items[0].echoes.count != 2;
        for (size_t k = 0; k < frame.targets.count; k++)
            ours += !isfinite(frame.targets.items[k].amplitude_db);
        arena_clear(check_arena());
    }
    hard_case("21", "amplitude 0 in decibels", "wrong", naive, ours, 0);
}
