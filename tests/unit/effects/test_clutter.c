#include "support/effect_bench.h"

/* A car drives at 10 m/s and turns by 0.3 rad/s; its sensor is 2 m ahead of its centre and 0.5 m to
 * the left. */
static void prepare(struct effect_bench *bench, double per_m2)
{
    struct sensor *sensor = &bench->sensor;
    struct object *ego = frame_object(&bench->frame, "ego");
    sensor->range_max_m = 50;
    sensor->calibration_ercs = 1e-6; /* no point is too weak */
    sensor->field_of_view_rad = 1;
    sensor->mount_x_m = 2;
    sensor->mount_y_m = 0.5;
    sensor->mount_yaw_rad = 0.4;
    ego->vx_mps = 10;
    ego->yaw_rate_radps = 0.3;
    bench->frame.conditions.clutter_per_m2 = per_m2;
    bench->frame.conditions.clutter_ercs = 0.1;
}

static struct echo_span clutter_of(struct effect_bench *bench)
{
    struct effect_scan scan = effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_SENSOR);
    return effect_added_echoes(&scan);
}

/* Ring 2 of a sensor that sees from 1 to 50 m is from 25 to 35.36 m, where 0.05 a square metre make
 * 0.05/2 (1250 - 625) points. The velocity of the sensor is (10 - 0.3 0.5, 0.3 2) m/s. */
EFFECT_TEST(points_lie_where_their_draws_put_them)
{
    prepare(bench, 0.05);
    bench->sensor.mount_z_m = 0.5;
    bench->sensor.elevation_view_rad = 0.3;
    bench->frame.time_s = 3;
    struct echo_span points = clutter_of(bench);
    struct random_address address = frame_draw_address_of_scan(&bench->frame, "radar");
    address.item = 2;
    double waited = 0;
    uint32_t rank = 0;
    assert_in_range(points.count, 30, 100);
    for (size_t i = 0; i < points.count; i++) {
        const struct echo *point = &points.items[i];
        double direction_rad = 0.4 + point->azimuth_rad;
        assert_close(point->range_rate_mps, -9.85 * cos(direction_rad) - 0.6 * sin(direction_rad),
                     1e-13);
        assert_close(point->time_s, 3, 0);
        assert_string_equal(point->id.object, "clutter");
        assert_string_equal(point->id.reflector, "ground");
        assert_int_equal(point->id.path, PATH_CLUTTER);
        assert_true(point->effects == EFFECT_BIT(EFFECT_CLUTTER));
        assert_near(tan(point->elevation_rad), -0.5 / point->range_m, 1e-14);
        if (point->id.number % 16 != 2)
            continue;
        double uniform[4];
        random_uniform(&address, effect_clutter.purposes[0], rank, uniform);
        waited -= log(uniform[2]);
        assert_int_equal(point->id.number, 2 + 16 * rank++);
        assert_near(point->range_m, sqrt(625 + 625 * uniform[0]), 1e-14);
        assert_close(point->azimuth_rad, uniform[1] - 0.5, 0);
        assert_near(point->ercs, 0.1 * sqrt(-log(waited / (0.05 / 2 * 625))), 1e-12);
    }
    assert_in_range(rank, 5, 30);
}

/* The number of all points has the mean of density times area, and f times its variance. */
EFFECT_TEST(numbers_have_the_mean_and_variance_of_their_law)
{
    enum { SCANS = 4000 };
    static const double factors[] = {0, 1, 4, 60};
    for (size_t i = 0; i < COUNT(factors); i++) {
        prepare(bench, 0.01);
        bench->frame.conditions.clutter_overdispersion = factors[i];
        double mean = 0.01 * (2500 - 1) / 2, factor = factors[i] > 1 ? factors[i] : 1;
        double sum = 0, squares = 0;
        for (bench->frame.frame = 0; bench->frame.frame < SCANS; bench->frame.frame++) {
            double count = (double)clutter_of(bench).count;
            sum += count;
            squares += (count - mean) * (count - mean);
        }
        assert_close(sum / SCANS, mean, 4 * sqrt(factor * mean / SCANS));
        assert_near(squares / SCANS, factor * mean, 0.12);
    }
}

static double power_of(const struct echo *point)
{
    double amplitude = point->ercs * 100 / (point->range_m * point->range_m);
    return amplitude * amplitude;
}

/* The bench's threshold is 1, and its reference amplitude 1 at 10 m, times 1e6 for a list of all.
 */
EFFECT_TEST(only_points_that_could_pass_the_threshold_are_listed)
{
    prepare(bench, 5);
    bench->frame.conditions.clutter_ercs = 0.01;
    bench->sensor.calibration_ercs = 1e-6;
    struct echo_span all = clutter_of(bench);
    prepare(bench, 5);
    bench->frame.conditions.clutter_ercs = 0.01;
    bench->sensor.calibration_ercs = 1;
    struct echo_span listed = clutter_of(bench);
    assert_true(listed.count > 100 && listed.count < all.count / 3);
    double left_out = 0;
    size_t next = 0;
    for (size_t i = 0; i < all.count; i++) {
        const struct echo *point = &all.items[i];
        if (next < listed.count && listed.items[next].id.number == point->id.number) {
            assert_true(listed.items[next].range_m == point->range_m);
            assert_true(listed.items[next++].ercs == point->ercs);
        } else {
            left_out += power_of(point);
            assert_true(power_of(point) < 0.01);
        }
    }
    assert_int_equal(next, listed.count);
    assert_true(left_out < 16 * 0.01);
}

EFFECT_TEST(a_dense_ground_is_listed_in_full_if_it_can_be_detected)
{
    prepare(bench, 10);
    bench->sensor.calibration_ercs = 1e-6;
    double mean = 10 * (2500 - 1) / 2.0;
    assert_close((double)clutter_of(bench).count, mean, 4 * sqrt(mean));
}

EFFECT_TEST(clutter_needs_points_power_and_a_sensor_that_measures)
{
    prepare(bench, 0.5);
    bench->frame.sensors.list.items[0].measured = false;
    assert_int_equal(clutter_of(bench).count, 0);
    bench->frame.sensors.list.items[0].measured = true;
    bench->frame.conditions.clutter_ercs = 0;
    assert_int_equal(clutter_of(bench).count, 0);
    prepare(bench, 0);
    assert_int_equal(clutter_of(bench).count, 0);
    assert_true((bench->log.left_out & EFFECT_BIT(EFFECT_CLUTTER)) != 0);
}
