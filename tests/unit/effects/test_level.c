#include "support/effect_bench.h"

#define SCAN_S 0.06

static void widen(struct effect_bench *bench, double constant_db, double slow_db, double fast_db)
{
    bench->sensor.level_constant_db = constant_db;
    bench->sensor.level_slow_db = slow_db;
    bench->sensor.level_slow_m = 56;
    bench->sensor.level_fast_db = fast_db;
}

/* A car ahead at a relative speed, after a time; the ego drives at 30 m/s. The first call gives the
 * frame its echo. */
static struct object *drive(struct effect_bench *bench, double range_m, double aside_m,
                            double relative_mps, double time_s)
{
    struct object *ego = frame_object(&bench->frame, "ego");
    struct object *other = frame_object(&bench->frame, "other");
    bench->frame.time_s = time_s;
    ego->vx_mps = 30;
    ego->x_m = ego->travelled_m = 30 * time_s;
    other->vx_mps = 30 + relative_mps;
    other->travelled_m = other->vx_mps * time_s;
    other->x_m = ego->x_m + range_m + relative_mps * time_s;
    other->y_m = aside_m;
    other->length_m = 4.5;
    if (bench->frame.echoes.count == 0)
        *list_add(&bench->frame.echoes, check_arena()) = effect_bench_echo(range_m);
    return other;
}

static double factor_of(struct effect_bench *bench)
{
    return effect_bench_factor(bench, EFFECT_LEVEL, &bench->frame.echoes.items[0]);
}

static double level_db(struct effect_bench *bench)
{
    return units_amplitude_db(factor_of(bench));
}

EFFECT_TEST(all_echoes_of_a_body_have_its_level)
{
    drive(bench, 50, 0, 0, 0);
    widen(bench, 6, 4, 3.6);
    struct echo corner = effect_bench_echo(52), ghost = effect_bench_echo(70), clutter = corner;
    corner.id.reflector = "q";
    ghost.id.path = PATH_WALL_OBJECT;
    clutter.id.object = "clutter";
    double factor = factor_of(bench);
    assert_true(factor > 0 && factor != 1);
    assert_close(effect_bench_factor(bench, EFFECT_LEVEL, &corner), factor, 0);
    assert_close(effect_bench_factor(bench, EFFECT_LEVEL, &ghost), factor, 0);
    *list_add(&bench->frame.echoes, check_arena()) = clutter;
    assert_close(effect_bench_factor(bench, EFFECT_LEVEL, &clutter), 1, 0);
}

/* Its mean and deviation over bodies, by whose power is kept: exp(s^2) - 1 is the variance of the
 * power of a level of s nepers. */
EFFECT_TEST(levels_keep_the_mean_or_the_median_of_the_power)
{
    enum { BODIES = 10000 };
    static const double widths[][3] = {{3, 0, 0}, {0, 3, 0}, {0, 0, 3}, {2, 2, 1}};
    drive(bench, 50, 0, 3, 1.234);
    for (size_t i = 0; i < COUNT(widths); i++)
        for (int keeps = LEVEL_KEEPS_MEAN; keeps <= LEVEL_KEEPS_MEDIAN; keeps++) {
            double power = 0, mean = 0, square = 0;
            bench->sensor.level_keeps = (enum level_keeps)keeps;
            widen(bench, widths[i][0], widths[i][1], widths[i][2]);
            for (bench->frame.seed = 0; bench->frame.seed < BODIES; bench->frame.seed++) {
                double db = level_db(bench);
                power += pow(10, db / 10) / BODIES;
                mean += db / BODIES;
                square += db * db / BODIES;
            }
            double nepers = 3 * log(10) / 10;
            double kept = keeps == LEVEL_KEEPS_MEAN ? 1 : exp(nepers * nepers / 2);
            assert_close(power, kept, 5 * kept * sqrt(expm1(nepers * nepers) / BODIES));
            assert_close(mean, keeps == LEVEL_KEEPS_MEAN ? -9 * log(10) / 20 : 0,
                         15 / sqrt(BODIES));
            assert_close(sqrt(square - mean * mean), 3, 15 / sqrt(2.0 * BODIES));
        }
}

/* The same for every sensor: two at one place see one interference, and the others' places tell
 * their levels apart. */
EFFECT_TEST(a_constant_level_stays_and_a_moved_sensor_has_another_fast_one)
{
    drive(bench, 50, 3, 5, 0);
    widen(bench, 6, 0, 0);
    double constant = level_db(bench);
    bench->frame.frame = 7;
    bench->sensor.mount_y_m = 0.5;
    drive(bench, 50, 3, 5, 1);
    assert_close(level_db(bench), constant, 0);
    widen(bench, 0, 4, 0);
    double slow = level_db(bench);
    bench->sensor.mount_y_m = 0;
    assert_close(level_db(bench), slow, 0);
    widen(bench, 0, 0, 4);
    double fast = level_db(bench);
    bench->sensor.mount_y_m = 0.5;
    assert_true(fabs(level_db(bench) - fast) > 1e-3);
}

/* Seen from one place on end, from behind and again after a whole turn. */
EFFECT_TEST(a_level_closes_after_a_turn_of_the_body)
{
    struct object *other = drive(bench, 50, 0, 0, 0);
    widen(bench, 0, 0, 4);
    double first = level_db(bench);
    other->yaw_rad = 1e-9;
    assert_close(level_db(bench), first, 1e-3);
    other->yaw_rad = -1e-9;
    assert_close(level_db(bench), first, 1e-3);
    other->yaw_rad = PI;
    double ahead = level_db(bench);
    other->yaw_rad = PI - 1e-9;
    assert_close(level_db(bench), ahead, 1e-3);
    assert_true(fabs(ahead - first) > 1e-3);
}

/* A scan that is 50 ms old has the level of a frame 50 ms earlier. */
EFFECT_TEST(a_late_scan_has_the_level_of_its_instant)
{
    widen(bench, 6, 4, 3.6);
    drive(bench, 50, 3, 5, 1);
    bench->frame.interval_s = 0.06;
    double now = level_db(bench);
    drive(bench, 50, 3, 5, 1.05);
    bench->sensor.latency_s = 0.05;
    struct effect_scan scan = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_SENSOR);
    const struct object *other = frame_object(&bench->frame, "other");
    double factor = scan.constants[EFFECT_LEVEL][other - bench->frame.objects.items];
    assert_close(units_amplitude_db(factor), now, 1e-9);
}

EFFECT_TEST(a_class_may_have_levels_of_its_own)
{
    drive(bench, 50, 0, 0, 0);
    struct class_document *car = list_add(&bench->frame.vehicles, check_arena());
    *car = (struct class_document){.class = "car", .level = {-1, -1, -1}};
    widen(bench, 6, 0, 0);
    bench->sensor.level_keeps = LEVEL_KEEPS_MEDIAN;
    double sensors = level_db(bench);
    car->level.constant_db = 3;
    assert_near(level_db(bench), sensors / 2, 1e-12);
    car->level.constant_db = 0;
    assert_close(factor_of(bench), 1, 0);
    widen(bench, 0, 0, 0);
    assert_true(effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_SENSOR).effects == 0);
    car->level.constant_db = 6;
    assert_close(level_db(bench), sensors, 0);
}

static double correlation(double knots)
{
    return knots < 2 ? (1 - knots / 2) * cos(PI * knots / 2) + sin(PI * knots / 2) / PI : 0;
}

/* Jitter of 1 mm in range and of 0.01 mrad in aspect, each even with that deviation. */
EFFECT_TEST(a_parked_car_before_a_standing_radar_keeps_its_level)
{
    enum { CARS = 4000 };
    double product = 0, square = 0;
    widen(bench, 0, 0, 3.6);
    bench->sensor.level_keeps = LEVEL_KEEPS_MEDIAN;
    for (bench->frame.seed = 0; bench->frame.seed < CARS; bench->frame.seed++) {
        double db[2];
        for (int scan = 0; scan < 2; scan++) {
            struct random_address address = {.seed = bench->frame.seed, .frame = (uint64_t)scan};
            double uniform[4];
            random_uniform(&address, RANDOM_TRAFFIC, 0, uniform);
            struct object *car = drive(bench, 20 + 1e-3 * sqrt(12) * (uniform[0] - 0.5), 2, 0, 0);
            car->yaw_rad = 0.3 + 1e-5 * sqrt(12) * (uniform[1] - 0.5);
            db[scan] = level_db(bench);
        }
        product += db[0] * db[1] / CARS;
        square += (db[0] * db[0] + db[1] * db[1]) / 2 / CARS;
    }
    print_message("lag-1 correlation of the fast level of a parked car: %.4f\n", product / square);
    assert_true(product / square >= 0.95);
}

/* Cars of one's own lane at 30 m/s: half the mean squared difference of levels at lags of 60 ms. A
 * constant part adds nothing to it. */
EFFECT_TEST(levels_change_over_scans_as_knots_pass)
{
    enum { CARS = 400 };
    static const double relative_mps[] = {1, 2, 3, 4}, speed_mps = 30;
    static const int lags[] = {1, 5, 12, 25};
    widen(bench, 6, 4, 3.6);
    for (size_t i = 0; i < COUNT(lags); i++) {
        double found = 0, expected = 0;
        for (size_t k = 0; k < COUNT(relative_mps); k++) {
            double v = relative_mps[k], lag_s = lags[i] * SCAN_S;
            for (bench->frame.seed = 0; bench->frame.seed < CARS; bench->frame.seed++)
                for (int n = 0; n < 5; n++) {
                    drive(bench, 40, 0, v, 10 * n);
                    double before = level_db(bench);
                    drive(bench, 40, 0, v, 10 * n + lag_s);
                    double change = level_db(bench) - before;
                    found += change * change / 2 / (5 * CARS * COUNT(relative_mps));
                }
            expected += (16 * (1 - correlation(lag_s * (2 * speed_mps + v) / 56)) +
                         3.6 * 3.6 * (1 - correlation(lag_s * v / 0.23))) /
                        COUNT(relative_mps);
        }
        print_message("semivariance %2d scans apart: %.1f dB2\n", lags[i], found);
        assert_close(found, expected, 0.1 * expected);
    }
}
