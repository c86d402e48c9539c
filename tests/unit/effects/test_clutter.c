#include "support/effect_bench.h"

/* A car drives at 10 m/s and turns by 0.3 rad/s; its sensor is 2 m ahead of its centre and 0.5 m to
 * the left. */
static void prepare(struct effect_bench *bench, double per_m2)
{
    struct sensor *sensor = &bench->sensor;
    struct object *ego = frame_object(&bench->frame, "ego");
    sensor->range_max_m = 50;
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

/* Points stand still, uniform over an area of (50^2 - 1)/2 m^2. The velocity of the sensor is
 * (10 - 0.3 0.5, 0.3 2) m/s. */
static void points_lie_where_their_draws_put_them(void **state)
{
    struct effect_bench *bench = *state;
    prepare(bench, 0.05);
    bench->frame.time_s = 3;
    const struct echo ground = {
        .id = {.object = "clutter", .reflector = "ground", .path = PATH_CLUTTER}};
    struct echo_span points = clutter_of(bench);
    assert_in_range(points.count, 30, 100);
    for (size_t i = 0; i < points.count; i++) {
        const struct echo *point = &points.items[i];
        double uniform[4];
        effect_bench_draw(bench, &ground, RANDOM_CLUTTER, (uint32_t)i + 1, uniform);
        assert_near(point->range_m, sqrt(1 + (2500 - 1) * uniform[0]), 1e-14);
        assert_close(point->azimuth_rad, uniform[1] - 0.5, 0);
        assert_near(point->ercs, 0.1 * sqrt(-log(uniform[2])), 1e-14);
        double direction_rad = 0.4 + point->azimuth_rad;
        assert_close(point->range_rate_mps, -9.85 * cos(direction_rad) - 0.6 * sin(direction_rad),
                     1e-13);
        assert_close(point->time_s, 3, 0);
        assert_string_equal(point->id.object, "clutter");
        assert_string_equal(point->id.reflector, "ground");
        assert_int_equal(point->id.path, PATH_CLUTTER);
        assert_int_equal(point->id.number, i + 1);
        assert_true(point->effects == EFFECT_BIT(EFFECT_CLUTTER));
    }
}

/* For a Poisson mean of 62.475, the count is that with P(N <= count - 1) < uniform <= P(N <=
 * count).
 */
static void the_number_of_points_is_that_of_the_draw(void **state)
{
    struct effect_bench *bench = *state;
    const struct echo ground = {
        .id = {.object = "clutter", .reflector = "ground", .path = PATH_CLUTTER}};
    prepare(bench, 0.05);
    for (bench->frame.frame = 0; bench->frame.frame < 50; bench->frame.frame++) {
        double mean = 0.05 * (2500 - 1) / 2, chance = exp(-mean), below = 0, uniform[4];
        effect_bench_draw(bench, &ground, RANDOM_CLUTTER, 0, uniform);
        size_t count = clutter_of(bench).count;
        for (size_t k = 0; k < count; k++) {
            below += chance;
            chance *= mean / (double)(k + 1);
        }
        assert_true(below < uniform[0] && uniform[0] <= below + chance);
    }
}

static void points_after_the_first_1000_are_left_out(void **state)
{
    struct effect_bench *bench = *state;
    prepare(bench, 0.5);
    struct echo_span few = clutter_of(bench);
    prepare(bench, 10);
    struct echo_span most = clutter_of(bench);
    assert_in_range(few.count, 500, 750);
    assert_int_equal(most.count, 1000);
    for (size_t i = 0; i < few.count; i++) {
        assert_int_equal(few.items[i].id.number, most.items[i].id.number);
        assert_true(few.items[i].range_m == most.items[i].range_m);
        assert_true(few.items[i].azimuth_rad == most.items[i].azimuth_rad);
    }
}

static void clutter_needs_points_power_and_a_sensor_that_measures(void **state)
{
    struct effect_bench *bench = *state;
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        EFFECT_TEST(points_lie_where_their_draws_put_them),
        EFFECT_TEST(the_number_of_points_is_that_of_the_draw),
        EFFECT_TEST(points_after_the_first_1000_are_left_out),
        EFFECT_TEST(clutter_needs_points_power_and_a_sensor_that_measures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
