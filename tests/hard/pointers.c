/* From echoes to targets: hard frames through the stages themselves. */
#include "hard.h"

#include <complex.h>

#include "base/elementary.h"
#include "base/hash.h"
#include "base/units.h"
#include "frame/frame_order.h"
#include "frame/frame_text.h"
#include "ideal/direct_echoes.h"
#include "propagation/carrier.h"
#include "run/runner.h"
#include "sensor/resolution_cell.h"

enum { BITS = 400, SUM_BITS = 2000 };

extern const struct stage stage_sensor, stage_noise_none;

/* One radar whose reference amplitude is 1 at 20 m, and the stages that use it. */
struct bench {
    struct sensor sensor;
    struct suite suite;
    struct runner sense, list;
    struct frame frame;
    struct arena arena;
};

static void open_stage(struct runner *runner, const struct stage *stage, const struct suite *suite)
{
    static const char *const words[] = {"--sections", "echoes,cells"};
    assert_int_equal(runner_prepare(runner, stage, 2, words), 0);
    *list_add(&runner->suites, &runner->arena) = suite;
    assert_int_equal(runner_start(runner), 0);
}

static void bench_open(struct bench *bench, enum antenna_phase phase,
                       enum monopulse_estimator estimator)
{
    *bench = (struct bench){
        .sensor = {.name = "s",
                   .carrier_hz = 77e9,
                   .range_max_m = 1e6,
                   .field_of_view_rad = PI,
                   .calibration_ercs = 1,
                   .calibration_range_m = 20,
                   .exponent = 2,
                   .range_floor_m = 0.5,
                   .cell_range_m = 0.3,
                   .cell_range_rate_mps = 0.5,
                   .phase_reference = phase,
                   .angle_estimator = estimator},
        .suite = {.name = "bench", .digest = "0"},
    };
    suite_derive(&bench->sensor);
    bench->suite.sensors.items = &bench->sensor;
    bench->suite.sensors.count = 1;
    bench->frame.arena = &bench->arena;
    open_stage(&bench->sense, &stage_sensor, &bench->suite);
    open_stage(&bench->list, &stage_noise_none, &bench->suite);
}

static void bench_close(struct bench *bench)
{
    runner_free(&bench->sense);
    runner_free(&bench->list);
    arena_free(&bench->arena);
}

static void bench_begin(struct bench *bench)
{
    struct frame *frame = &bench->frame;
    frame_clear(frame);
    frame->scene = "bench";
    frame->interval_s = 1;
    frame->ego = "ego";
    frame->sections |= CARRY_ACCOUNT;
    frame->sensors.suite = bench->suite.name;
    frame->sensors.digest = bench->suite.digest;
    *list_add(&frame->sensors.list, frame->arena) =
        (struct sensor_view){.name = "s", .measured = true};
    frame->present = PART_SENSORS | PART_ECHOES | PART_COUNTS;
}

static void count_echoes(struct frame *frame)
{
    struct count *count = list_add(&frame->counts, frame->arena);
    *count = (struct count){.sensor = "s", .pairs = (int64_t)frame->echoes.count};
    *list_add(&count->paths, frame->arena) = (struct path_count){.echoes = count->pairs};
}

static void add_echo(struct frame *frame, const char *object, double range_m, double azimuth_rad,
                     double ercs)
{
    *list_add(&frame->echoes, frame->arena) = (struct echo){.sensor = "s",
                                                            .id.object = object,
                                                            .id.reflector = "r",
                                                            .range_m = range_m,
                                                            .azimuth_rad = azimuth_rad,
                                                            .ercs = ercs};
}

/* Runs both stages. They refuse values that are not finite, and echoes that are neither in a target
 * nor lost. */
static bool bench_step(struct bench *bench)
{
    frame_order(&bench->frame);
    return runner_step(&bench->sense, &bench->frame) == 0 &&
           runner_step(&bench->list, &bench->frame) == 0;
}

/* The azimuth of a lone echo's target, or NaN if there is not one target. */
static double lone_azimuth(struct bench *bench, double azimuth_rad, double ercs)
{
    bench_begin(bench);
    add_echo(&bench->frame, "o", 20, azimuth_rad, ercs);
    count_echoes(&bench->frame);
    if (!bench_step(bench) || bench->frame.targets.count != 1)
        return (double)NAN;
    return bench->frame.targets.items[0].azimuth_rad;
}

/* The same azimuth without glint's functions: equation (6) as printed, and the arcsine of (7). */
static double naive_lone_azimuth(double azimuth_rad)
{
    double x = PI * sin(azimuth_rad);
    double _Complex turn = cexp(x * (double _Complex)I);
    double sum = sqrt((1 + cos(x)) / 2), delta = sqrt((1 - cos(x)) / 2);
    return copysign(asin(2 / PI * atan2(delta, sum)), -cimag((1 - turn) * conj(1 + turn)));
}

static const enum antenna_phase PHASES[] = {PHASE_CENTRE, PHASE_ELEMENT};
static const enum monopulse_estimator ESTIMATORS[] = {MONOPULSE_MAGNITUDE, MONOPULSE_RATIO};

static struct look look_at_pole(struct bench *bench, struct vec2 ego, struct vec2 pole)
{
    struct frame *frame = &bench->frame;
    bench_begin(bench);
    *list_add(&frame->objects, frame->arena) =
        (struct object){.id = "ego", .class = "car", .x_m = ego.x, .y_m = ego.y};
    *list_add(&frame->objects, frame->arena) =
        (struct object){.id = "pole", .class = "post", .x_m = pole.x, .y_m = pole.y};
    struct reflector_set *set = list_add(&frame->reflectors, frame->arena);
    *set = (struct reflector_set){.model = "post"};
    *list_add(&set->objects, frame->arena) = "pole";
    *list_add(&set->points, frame->arena) = (struct point_reflector){
        .name = "r", .full_rad = PI, .zero_rad = PI, .shape = VISIBILITY_HARD, .ercs = 1};
    frame->present |= PART_OBJECTS | PART_REFLECTORS;
    struct look look;
    static const struct selection everything = {.allowed = EFFECT_BIT(EFFECT_COUNT) - 1};
    assert_done(look_begin, &look, frame, &bench->sensor, &everything, 0);
    direct_echoes_add(&look);
    return look;
}

/* A pole at the sensor's own place is out of range by rule; one that is an ulp ahead is a
 * target. */
TEST(a_target_on_the_sensor_is_told)
{
    struct bench bench;
    bench_open(&bench, PHASE_CENTRE, MONOPULSE_RATIO);
    uint64_t sample = 34;
    int naive = 0, ours = 0, count = hard_points(10000);
    for (int i = 0; i < count; i++) {
        bool on = i % 2 == 0;
        struct vec2 ego = {sample_between(&sample, -500, 500), sample_between(&sample, -500, 500)};
        struct vec2 pole = {on ? ego.x : nextafter(ego.x, 1e9), ego.y};
        double range_m = hypot(pole.x - ego.x, pole.y - ego.y);
        naive += !isfinite(20 / range_m * (20 / range_m) * ((pole.x - ego.x) / range_m));
        struct look look = look_at_pole(&bench, ego, pole);
        const struct frame *frame = &bench.frame;
        bool lost = frame->lost.count == 1 &&
                    frame_loss_of(frame->lost.items[0].reason) == LOSS_OUT_OF_RANGE;
        bool good = look.pairs == 1 && lost == on && bench_step(&bench) &&
                    frame->targets.count == (on ? 0 : 1);
        ours += !good;
    }
    hard_case("range 0", "a target on the sensor", "wrong", naive, ours, 0);
    bench_close(&bench);
}

/* Azimuths ever nearer to boresight, and to the side up to the double that stands for 90
 * degrees. */
TEST(lone_targets_stay_where_they_are)
{
    double naive_ahead = 0, ours_ahead = 0, naive_side = 0, ours_side = 0;
    MPFR_DECL_INIT(exact, BITS);
    for (int k = 0; k < 4; k++) {
        struct bench bench;
        bench_open(&bench, PHASES[k / 2], ESTIMATORS[k % 2]);
        int count = hard_points(1000);
        for (int i = 0; i < count; i++) {
            int side = i % 2 == 0 ? 1 : -1;
            double azimuth_rad = side * pow(10, -9 - 130.0 * i / count);
            mpfr_set_d(exact, azimuth_rad, MPFR_RNDN);
            ours_ahead =
                hard_worse(ours_ahead, error_ulp(lone_azimuth(&bench, azimuth_rad, 1), exact));
            naive_ahead =
                hard_worse(naive_ahead, error_ulp(naive_lone_azimuth(azimuth_rad), exact));
            azimuth_rad = side * (PI / 2 - (i < 10 ? 0 : pow(10, -6 - 10.0 * i / count)));
            double back = lone_azimuth(&bench, azimuth_rad, 1e70);
            ours_side = hard_worse(ours_side, fabs(back - azimuth_rad));
            naive_side =
                hard_worse(naive_side, fabs(naive_lone_azimuth(azimuth_rad) - azimuth_rad));
        }
        bench_close(&bench);
    }
    hard_case("boresight", "a lone target at 1e-9 rad and nearer", "ulp", naive_ahead, ours_ahead,
              8);
    hard_case("side", "a lone target at 90 degrees and before", "rad", naive_side, ours_side,
              5e-16);
}

/* The cell of received echoes that are given in any order. */
static struct cell cell_of(const struct sensor *sensor, struct received_echo *received_echoes,
                           size_t count, struct arena *arena)
{
    struct cell cell;
    arena_clear(arena);
    qsort(received_echoes, count, sizeof *received_echoes, resolution_cell_compare);
    assert_true(resolution_cell_of(sensor, received_echoes, count, true, arena, &cell));
    return cell;
}

static struct received_echo ray_at(const struct sensor *sensor, const char *object,
                                   double azimuth_rad, double strength)
{
    struct received_echo received = {
        .echo = {.id.object = object, .id.reflector = "r", .azimuth_rad = azimuth_rad},
        .strength = strength,
        .amplitude = strength * antenna_gain(&sensor->antenna, azimuth_rad)};
    return received;
}

static struct cell pair_of(const struct sensor *sensor, double azimuth_rad, double left,
                           double right, struct arena *arena)
{
    struct received_echo received_echoes[] = {ray_at(sensor, "left", azimuth_rad, left),
                                              ray_at(sensor, "right", -azimuth_rad, right)};
    return cell_of(sensor, received_echoes, 2, arena);
}

/* The azimuth of a pair by plain sums and the paper's sign, as rounding gives it. */
static double naive_pair(double azimuth_rad, double left, double right, bool element)
{
    double x = PI * sin(azimuth_rad), u = x / 2;
    double _Complex turn = cexp((element ? u : 0) * (double _Complex)I);
    double cosine = sqrt((1 + cos(x)) / 2), sine = sqrt((1 - cos(x)) / 2);
    double _Complex sum = cosine * (left * turn + right * conj(turn));
    double _Complex delta = -(double _Complex)I * sine * (left * turn - right * conj(turn));
    return copysign(asin(2 / PI * atan2(cabs(delta), cabs(sum))), -cimag(delta * conj(sum)));
}

/* The azimuth of the i-th pair, from 1e-9 rad to the given one: in equal ratios below 1 deg and in
 * equal steps above. */
static double pair_azimuth(int i, int count, double most_rad)
{
    double part = (double)(i / 2) / (count / 2);
    return i % 2 == 0 ? 1e-9 * pow(DEGREE / 1e-9, part) : DEGREE + part * (most_rad - DEGREE);
}

/* The exact azimuth at which equal echoes to both sides appear under the phase of the element: u' =
 * atan(tan^2 u), MODEL 8.1. */
static void set_equal_pair(mpfr_t azimuth, double azimuth_rad)
{
    MPFR_DECL_INIT(quarter, BITS);
    mpfr_const_pi(quarter, MPFR_RNDN);
    mpfr_div_2ui(quarter, quarter, 1, MPFR_RNDN);
    mpfr_set_d(azimuth, azimuth_rad, MPFR_RNDN);
    mpfr_sin(azimuth, azimuth, MPFR_RNDN);
    mpfr_mul(azimuth, azimuth, quarter, MPFR_RNDN);
    mpfr_tan(azimuth, azimuth, MPFR_RNDN);
    mpfr_sqr(azimuth, azimuth, MPFR_RNDN);
    mpfr_atan(azimuth, azimuth, MPFR_RNDN);
    mpfr_div(azimuth, azimuth, quarter, MPFR_RNDN);
    mpfr_asin(azimuth, azimuth, MPFR_RNDN);
}

TEST(equal_echoes_meet_where_their_closed_form_says)
{
    double naive_middle = 0, ours_middle = 0, naive = 0, ours = 0;
    MPFR_DECL_INIT(exact, BITS);
    uint64_t sample = 1;
    for (int k = 0; k < 4; k++) {
        struct bench bench;
        bench_open(&bench, PHASES[k / 2], ESTIMATORS[k % 2]);
        bool magnitude = k % 2 == 0, literal = k == 2;
        int count = hard_points(20000);
        for (int i = 0; i < count; i++) {
            double azimuth_rad = pair_azimuth(i, count, 80 * DEGREE);
            double strength = exp(sample_between(&sample, -7, 7));
            struct cell cell =
                pair_of(&bench.sensor, azimuth_rad, strength, strength, check_arena());
            bool flagged = cell.sign_undecided == magnitude;
            double plain = naive_pair(azimuth_rad, strength, strength, k >= 2);
            if (literal) {
                set_equal_pair(exact, azimuth_rad);
                ours = hard_worse(ours, flagged ? error_ulp(cell.azimuth_rad, exact) : HUGE_VAL);
                naive = hard_worse(naive, error_ulp(plain, exact));
            } else {
                ours_middle = hard_worse(ours_middle, flagged ? fabs(cell.azimuth_rad) : HUGE_VAL);
                naive_middle = hard_worse(naive_middle, fabs(plain));
            }
        }
        bench_close(&bench);
    }
    hard_case("pair", "equal echoes to both sides: 0 degrees", "rad", naive_middle, ours_middle, 0);
    hard_case("pair element", "equal echoes, element and magnitude", "ulp", naive, ours, 12);
}

/* How far one ulp of either strength moves the azimuth of a pair of equal echoes. */
static double pair_jump(const struct sensor *sensor, double azimuth_rad, double strength,
                        struct arena *arena)
{
    double more = nextafter(strength, HUGE_VAL);
    double even = pair_of(sensor, azimuth_rad, strength, strength, arena).azimuth_rad;
    double left = pair_of(sensor, azimuth_rad, more, strength, arena).azimuth_rad;
    double right = pair_of(sensor, azimuth_rad, strength, more, arena).azimuth_rad;
    return hard_worse(fabs(left - even), fabs(right - even));
}

static double naive_jump(double azimuth_rad, double strength, bool element)
{
    double more = nextafter(strength, HUGE_VAL);
    return fabs(naive_pair(azimuth_rad, more, strength, element) -
                naive_pair(azimuth_rad, strength, more, element));
}

/* The angle is continuous under the phase of the centre, and with the ratio under that of the
 * element, up to 75 degrees: the exact ratio itself moves by 2^-52 sin u / (2 cos^3 u).
 *
 * With the paper's magnitude under the element a side that one ulp decides is called undecided, but
 * not near boresight: there |delta| is 2 f sin^2 u, and the exact pointers' phase for one ulp, and
 * half of one from either product, is 2^-52 / tan u, which is more than 2^-47 up to tan u = 1/32,
 * 1.14 degrees. What then jumps is an angle of (2/pi) u^2 to either side, 1.25e-3 rad in all. Sums
 * without rounding do not change that: it is the echoes that are not even. */
TEST(one_ulp_of_an_echo_does_not_make_the_angle_jump)
{
    static const struct {
        const char *number, *title;
        enum antenna_phase phase;
        enum monopulse_estimator estimator;
        double most_deg, bound;
    } cases[] = {
        {"jump 1", "one ulp, centre and ratio", PHASE_CENTRE, MONOPULSE_RATIO, 80, 1e-12},
        {"jump 2", "one ulp, centre and magnitude", PHASE_CENTRE, MONOPULSE_MAGNITUDE, 80, 1e-12},
        {"jump 3", "one ulp, element and ratio", PHASE_ELEMENT, MONOPULSE_RATIO, 75, 1e-12},
        {"jump 4", "one ulp, element and magnitude", PHASE_ELEMENT, MONOPULSE_MAGNITUDE, 80,
         1.25e-3},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        struct bench bench;
        bench_open(&bench, cases[k].phase, cases[k].estimator);
        uint64_t sample = 11;
        double naive = 0, ours = 0;
        int count = hard_points(50000);
        for (int i = 0; i < count; i++) {
            double azimuth_rad = pair_azimuth(i, count, cases[k].most_deg * DEGREE);
            double strength = exp(sample_between(&sample, -7, 7));
            ours = hard_worse(ours, pair_jump(&bench.sensor, azimuth_rad, strength, check_arena()));
            naive = hard_worse(naive, naive_jump(azimuth_rad, strength, true));
        }
        hard_case(cases[k].number, cases[k].title, "rad", naive, ours, cases[k].bound);
        bench_close(&bench);
    }
}

/* Sums of the pointers by plain additions, in the cell's order. */
static struct antenna_pointers naive_pointers(const struct sensor *sensor,
                                              const struct received_echo *received_echoes,
                                              size_t count)
{
    struct antenna_pointers total = {0, 0};
    for (size_t i = 0; i < count; i++) {
        struct antenna_pointers one =
            antenna_pointers(&sensor->antenna, received_echoes[i].echo.azimuth_rad);
        total.sum += received_echoes[i].strength * one.sum;
        total.delta += received_echoes[i].strength * one.delta;
    }
    return total;
}

/* As many equal echoes to the left as to the right have no sign, however many they are; plain sums
 * leave a phase of delta that passes for a sign. */
TEST(an_even_cell_has_no_sign)
{
    enum { SIDE = 20 };
    struct bench bench;
    bench_open(&bench, PHASE_ELEMENT, MONOPULSE_MAGNITUDE);
    uint64_t sample = 11;
    int naive = 0, ours = 0, count = hard_points(20000);
    for (int i = 0; i < count; i++) {
        double azimuth_rad = pair_azimuth(i, count, 80 * DEGREE);
        double strength = exp(sample_between(&sample, -7, 7));
        struct received_echo received_echoes[2 * SIDE];
        for (int k = 0; k < 2 * SIDE; k++)
            received_echoes[k] =
                ray_at(&bench.sensor, "o", k < SIDE ? azimuth_rad : -azimuth_rad, strength);
        ours += !cell_of(&bench.sensor, received_echoes, 2 * SIDE, check_arena()).sign_undecided;
        struct antenna_pointers plain = naive_pointers(&bench.sensor, received_echoes, 2 * SIDE);
        naive += !monopulse_angle(&bench.sensor.antenna, MONOPULSE_MAGNITUDE, plain).sign_undecided;
    }
    hard_case("even cell", "20 equal echoes to either side: a sign", "wrong", naive, ours, 0);
    bench_close(&bench);
}

/* The exact delta sum of the rounded products, and the sum of their sizes. */
static void set_delta(mpfr_t total, mpfr_t sizes, const struct sensor *sensor,
                      const struct received_echo *received_echoes, size_t count)
{
    mpfr_set_zero(total, 1);
    mpfr_set_zero(sizes, 1);
    for (size_t i = 0; i < count; i++) {
        double term =
            received_echoes[i].strength *
            cimag(antenna_pointers(&sensor->antenna, received_echoes[i].echo.azimuth_rad).delta);
        mpfr_add_d(total, total, term, MPFR_RNDN);
        mpfr_add_d(sizes, sizes, fabs(term), MPFR_RNDN);
    }
}

/* Hard case 13: echoes up to 1e16 to one side cancel with two of half their strength to the other;
 * what is left is the echo of a weak target. */
TEST(a_weak_target_outlives_strong_ones_that_cancel)
{
    enum { GROUPS = 40, ALL = 3 * GROUPS + 1 };
    struct bench bench;
    MPFR_DECL_INIT(exact, SUM_BITS);
    MPFR_DECL_INIT(sizes, SUM_BITS);
    bench_open(&bench, PHASE_CENTRE, MONOPULSE_RATIO);
    uint64_t sample = 13;
    double naive = 0, ours = 0;
    int count = hard_points(10000);
    for (int i = 0; i < count; i++) {
        struct received_echo received_echoes[ALL];
        for (int k = 0; k < 3 * GROUPS; k += 3) {
            double azimuth_rad = sample_between(&sample, -1, 1);
            double strength = pow(10, sample_between(&sample, 0, 16));
            received_echoes[k] = ray_at(&bench.sensor, "one", azimuth_rad, strength);
            received_echoes[k + 1] = ray_at(&bench.sensor, "half", -azimuth_rad, strength / 2);
            received_echoes[k + 2] =
                ray_at(&bench.sensor, "other half", -azimuth_rad, strength / 2);
        }
        set_delta(exact, sizes, &bench.sensor, received_echoes, 3 * GROUPS);
        double weak = mpfr_get_d(sizes, MPFR_RNDN) * pow(10, sample_between(&sample, -14.9, -1));
        received_echoes[3 * GROUPS] = ray_at(&bench.sensor, "weak", 0.5, weak / 0.5);
        struct cell cell = cell_of(&bench.sensor, received_echoes, ALL, check_arena());
        set_delta(exact, sizes, &bench.sensor, received_echoes, ALL);
        assert_true(mpfr_get_d(sizes, MPFR_RNDN) < 1e15 * fabs(mpfr_get_d(exact, MPFR_RNDN)));
        double plain = cimag(naive_pointers(&bench.sensor, received_echoes, ALL).delta);
        naive = hard_worse(naive, error_ulp(plain, exact));
        ours = hard_worse(ours, error_ulp(cell.delta_im, exact));
    }
    hard_case("13 cell", "a weak target where strong ones cancel", "ulp", naive, ours, 2);
    bench_close(&bench);
}

enum { CROWD = 300, ORDERS = 1000 };

static void add_unseen(uint64_t *seen, int *count, uint64_t value)
{
    for (int i = 0; i < *count; i++)
        if (seen[i] == value)
            return;
    seen[(*count)++] = value;
}

/* Hard case 14: a crowd of equal amplitudes with random phases, in random orders. */
TEST(the_order_of_echoes_does_not_change_a_byte)
{
    struct bench bench;
    bench_open(&bench, PHASE_ELEMENT, MONOPULSE_MAGNITUDE);
    bench.sensor.cell_phase = CELL_RANDOM_PHASE;
    char names[CROWD][16];
    int order[CROWD], naive = 0, ours = 0, count = hard_points(ORDERS);
    uint64_t sample = 14, *plain = calloc(ORDERS, sizeof *plain), *lines = calloc(ORDERS, 8);
    double terms[CROWD];
    for (int i = 0; i < CROWD; i++) {
        snprintf(names[i], sizeof names[i], "%d", i);
        order[i] = i;
        terms[i] = sin(i);
    }
    struct text *line = check_text();
    for (int round = 0; round < count; round++) {
        double sum = 0;
        bench_begin(&bench);
        for (int i = 0; i < CROWD; i++) {
            int other = i + (int)(sample_bits(&sample) % (uint64_t)(CROWD - i)),
                which = order[other];
            order[other] = order[i];
            order[i] = which;
            sum += terms[which];
            add_echo(&bench.frame, names[which], 20, which % 2 == 0 ? 0.2 : -0.2, 1);
            bench.frame.echoes.items[i].range_rate_mps = 0.01 * (which % 25);
        }
        count_echoes(&bench.frame);
        assert_int_equal(runner_step(&bench.sense, &bench.frame), 0);
        assert_int_equal(bench.frame.cells.count, 1);
        frame_drop(&bench.frame, PART_ECHOES); /* their order is another each time */
        line->length = 0;
        assert_done(frame_text_write, &bench.frame, line);
        add_unseen(lines, &ours, hash_bytes(HASH_START, line->bytes, line->length));
        add_unseen(plain, &naive, hash_bytes(HASH_START, &sum, sizeof sum));
    }
    hard_case("14 cell", "300 equal echoes in 1,000 orders: results", "results", naive, ours, 1);
    free(plain);
    free(lines);
    bench_close(&bench);
}

/* The exact azimuth by equation (8): u' = atan(|sum of g sin u| : sum of g cos u), g = G f. */
static void set_azimuth(mpfr_t azimuth, const struct received_echo *received_echoes, size_t count)
{
    mpfr_t quarter, u, sine, cosine, delta, sum;
    mpfr_inits2(SUM_BITS, quarter, u, sine, cosine, delta, sum, (mpfr_ptr)0);
    mpfr_const_pi(quarter, MPFR_RNDN);
    mpfr_div_2ui(quarter, quarter, 1, MPFR_RNDN);
    mpfr_set_zero(delta, 1);
    mpfr_set_zero(sum, 1);
    for (size_t i = 0; i < count; i++) {
        mpfr_set_d(u, received_echoes[i].echo.azimuth_rad, MPFR_RNDN);
        mpfr_sin_cos(u, azimuth, u, MPFR_RNDN);
        mpfr_mul(u, u, quarter, MPFR_RNDN);
        mpfr_sin_cos(sine, cosine, u, MPFR_RNDN);
        mpfr_div(u, sine, u, MPFR_RNDN);
        mpfr_mul(azimuth, azimuth, u, MPFR_RNDN);
        mpfr_mul_d(azimuth, azimuth, received_echoes[i].strength, MPFR_RNDN);
        mpfr_mul(sine, sine, azimuth, MPFR_RNDN);
        mpfr_mul(cosine, cosine, azimuth, MPFR_RNDN);
        mpfr_add(delta, delta, sine, MPFR_RNDN);
        mpfr_add(sum, sum, cosine, MPFR_RNDN);
    }
    mpfr_atan2(azimuth, delta, sum, MPFR_RNDN);
    mpfr_div(azimuth, azimuth, quarter, MPFR_RNDN);
    mpfr_asin(azimuth, azimuth, MPFR_RNDN);
    mpfr_clears(quarter, u, sine, cosine, delta, sum, (mpfr_ptr)0);
}

/* True if two echoes in one cell end as one target or as one lost group, by the threshold. */
static bool two_are_told(struct bench *bench, double first, double second,
                         struct received_echo received_echoes[2])
{
    const struct frame *frame = &bench->frame;
    bench_begin(bench);
    add_echo(&bench->frame, "first", 20, 0.3, first);
    add_echo(&bench->frame, "second", 20.1, -0.5, second);
    count_echoes(&bench->frame);
    bool told = bench_step(bench);
    for (int i = 0; i < 2; i++)
        received_echoes[i] =
            received_echo_in_free_space(&bench->sensor, &frame->echoes.items[i], 0);
    size_t targets =
        received_echoes[0].amplitude + received_echoes[1].amplitude >= bench->sensor.threshold;
    return told && frame->targets.count == targets && frame->lost.count == 1 - targets;
}

/* The ratio of MODEL 7.2 computed as it is written. */
static double naive_ratio(struct antenna_pointers pointers)
{
    double square = creal(pointers.sum) * creal(pointers.sum);
    return -cimag(pointers.delta * conj(pointers.sum)) / square;
}

/* Amplitudes from 1e-300 to 1e300 go through amplitude, mean, pointers, angle, threshold and
 * list. */
TEST(every_amplitude_is_a_target_or_told)
{
    MPFR_DECL_INIT(exact, SUM_BITS);
    double naive = 0, ours = 0;
    int wrong = 0, naive_wrong = 0;
    struct bench bench;
    bench_open(&bench, PHASE_CENTRE, MONOPULSE_RATIO);
    for (int strong = -300; strong <= 300; strong += 10)
        for (int weak = -300; weak <= strong; weak += 10) {
            struct received_echo received_echoes[2];
            bench.sensor.threshold = weak % 20 == 0 ? 1 : 1e-307;
            bench.sensor.lowered_threshold = bench.sensor.threshold;
            bench.sensor.angle_estimator = ESTIMATORS[strong / 10 % 2 == 0];
            wrong += !two_are_told(&bench, pow(10, strong), pow(10, weak), received_echoes);
            double tangent = naive_ratio(naive_pointers(&bench.sensor, received_echoes, 2));
            naive_wrong += !isfinite(tangent);
            struct cell cell = cell_of(&bench.sensor, received_echoes, 2, check_arena());
            set_azimuth(exact, received_echoes, 2);
            ours = hard_worse(ours, error_size(cell.azimuth_rad, exact));
            naive = hard_worse(naive, error_size(asin(2 / PI * atan(tangent)), exact));
        }
    bench_close(&bench);
    hard_case("1e300 list", "1e-300 to 1e300: not told", "wrong", naive_wrong, wrong, 0);
    hard_case("1e300 angle", "1e-300 to 1e300: the angle", "rad", naive, ours, 1e-15);
}

/* Two echoes whose sum of amplitudes is beyond the doubles. */
TEST(an_amplitude_beyond_doubles_is_told)
{
    struct bench bench;
    bench_open(&bench, PHASE_CENTRE, MONOPULSE_RATIO);
    bench_begin(&bench);
    add_echo(&bench.frame, "a", 20, 0, 1e308);
    add_echo(&bench.frame, "b", 20, 0, 1e308);
    count_echoes(&bench.frame);
    assert_false(bench_step(&bench));
    assert_int_equal(bench.sense.diag.code, DIAG_DATA);
    assert_string_equal(bench.sense.diag.text,
                        "object \"a\", seen by \"s\": amplitude: inf; expected a finite number");
    bench_close(&bench);
}

/* The error in radians of phases in turns, leaving out whole turns; uses the exact values up. */
static double turn_error_rad(mpfr_t exact, double turns)
{
    mpfr_sub_d(exact, exact, turns, MPFR_RNDN);
    mpfr_frac(exact, exact, MPFR_RNDN);
    double part = mpfr_get_d(exact, MPFR_RNDN);
    return 2 * PI * fabs(part - round(part));
}

static void set_turns(mpfr_t exact, double range_m, double carrier_hz)
{
    mpfr_set_d(exact, 2 * range_m, MPFR_RNDN);
    mpfr_mul_d(exact, exact, carrier_hz, MPFR_RNDN);
    mpfr_div_ui(exact, exact, 299792458, MPFR_RNDN);
}

/* Hard case 39. */
TEST(the_phase_of_the_path_keeps_its_digits)
{
    MPFR_DECL_INIT(exact, BITS);
    uint64_t sample = 39;
    double naive = 0, ours = 0;
    int count = hard_points(1000000);
    for (int i = 0; i < count; i++) {
        double range_m = sample_between(&sample, 0, 206);
        set_turns(exact, range_m, 77e9);
        ours = hard_worse(ours, turn_error_rad(exact, carrier_phase_turns(range_m, 77e9)));
        float single = 2 * (float)range_m / (float)(299792458 / 77e9);
        set_turns(exact, range_m, 77e9);
        naive = hard_worse(naive, turn_error_rad(exact, (double)single));
    }
    hard_case("39", "4 pi R/lambda at 77 GHz, naive in floats", "rad", naive, ours, 1e-14);
}
