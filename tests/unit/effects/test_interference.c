#include "support/effect_bench.h"

/* A radar of 33 dBm EIRP, 50 m away and in band, is 40.8748 dB over the noise of a receiver of 10
 * MHz with a noise figure of 12 dB behind an antenna of 20 dBi. */
static const double in_band_db = 40.8748;

static struct interferer *add_interferer(struct effect_bench *bench)
{
    struct interferer *other = list_add(&bench->frame.conditions.interferers, check_arena());
    *other = (struct interferer){"other", 33, 7.5e12, 1};
    bench->sensor.receiver_bandwidth_hz = 1e7;
    bench->sensor.noise_figure_db = 12;
    bench->sensor.antenna_gain_dbi = 20;
    bench->sensor.chirp_slope_hzps = 7.5e12;
    bench->sensor.chirp_s = 2e-5;
    return other;
}

static double interference_of(struct effect_bench *bench)
{
    return effect_bench_begin(bench, EVERY_EFFECT, EFFECT_HOME_SENSOR).interference;
}

static double interference_db(struct effect_bench *bench)
{
    return 10 * log10(interference_of(bench));
}

EFFECT_TEST(an_interferer_is_heard_where_it_stands)
{
    struct interferer *other = add_interferer(bench);
    struct object *object = frame_object(&bench->frame, "other");
    struct object *ego = frame_object(&bench->frame, "ego");
    assert_close(interference_db(bench), in_band_db, 6e-5);
    object->x_m = 100;
    assert_close(interference_db(bench), in_band_db - 20 * log10(2), 6e-5);
    /* The result is the same for a sensor ahead of an ego that is elsewhere and turned. */
    bench->sensor.mount_x_m = 2;
    bench->sensor.mount_y_m = 1;
    *ego = (struct object){.id = "ego", .class = "car", .x_m = 7, .y_m = -3, .yaw_rad = PI / 2};
    object->x_m = 6;
    object->y_m = 49;
    assert_close(interference_db(bench), in_band_db, 6e-5);
    bench->sensor.mount_yaw_rad = -PI / 2;
    object->x_m = 56;
    object->y_m = -1;
    assert_close(interference_db(bench), in_band_db, 6e-5);
    other->slope_hzps = -7.5e12;
    assert_close(interference_db(bench), in_band_db + 10 * log10(2.0 / 30), 6e-5);
    other->hit_share = 0.05;
    assert_close(interference_db(bench), in_band_db + 10 * log10(0.1 / 30), 6e-5);
    bench->sensor.if_sampling = IF_COMPLEX;
    assert_close(interference_db(bench), in_band_db + 10 * log10(0.05 / 30), 6e-5);
}

EFFECT_TEST(powers_of_several_interferers_add)
{
    add_interferer(bench);
    double single = interference_of(bench);
    add_interferer(bench)->hit_share = 0.25;
    assert_near(interference_of(bench), 1.25 * single, 1e-15);
}

/* The interferer approaches at 20 m/s: 0.5 s ago it was 60 m away. */
EFFECT_TEST(an_interferer_is_heard_at_the_instant_of_the_measurement)
{
    add_interferer(bench);
    frame_object(&bench->frame, "other")->vx_mps = -20;
    bench->sensor.latency_s = 0.5;
    assert_close(interference_db(bench), in_band_db - 20 * log10(60.0 / 50), 6e-5);
}

/* The two-way pattern in amplitude is the one-way pattern in power: 0.5513 at 30 degrees. */
EFFECT_TEST(the_antenna_counts_one_way)
{
    add_interferer(bench);
    struct object *object = frame_object(&bench->frame, "other");
    object->x_m = 50 * cos(PI / 6);
    object->y_m = 50 * sin(PI / 6);
    assert_close(interference_db(bench), in_band_db + 10 * log10(0.5513), 6e-4);
}

/* The sensor looks ahead from 2 m behind the ego's centre. */
EFFECT_TEST(interferers_out_of_view_are_not_heard)
{
    struct interferer *other = add_interferer(bench);
    struct object *object = frame_object(&bench->frame, "other");
    bench->sensor.mount_x_m = -2;
    static const struct {
        const char *id;
        double x_m, y_m;
        bool heard;
    } cases[] = {
        {"other", 50, 51.99, true}, {"other", 50, -51.99, true}, {"other", 50, 52.01, false},
        {"other", -50, 0, false},   {"other", -2, 0, false},     {"ego", 50, 0, false},
        {"gone", 50, 0, false},     {"other", 50, 0, true},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        other->object = cases[i].id;
        object->x_m = cases[i].x_m;
        object->y_m = cases[i].y_m;
        assert_int_equal(interference_of(bench) > 0, cases[i].heard);
    }
}

EFFECT_TEST(no_interferer_is_heard_without_a_bandwidth_or_without_the_effect)
{
    add_interferer(bench);
    uint64_t without = EVERY_EFFECT & ~EFFECT_BIT(EFFECT_INTERFERENCE);
    assert_close(effect_bench_begin(bench, without, EFFECT_HOME_SENSOR).interference, 0, 0);
    bench->sensor.receiver_bandwidth_hz = 0;
    assert_close(interference_of(bench), 0, 0);
}
