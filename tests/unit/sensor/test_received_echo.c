#include "check.h"

#include <stdlib.h>

#include "base/units.h"
#include "frame/draw_address.h"
#include "radar/swerling.h"
#include "sensor/received_echo.h"

#define EVERYTHING (EFFECT_BIT(EFFECT_COUNT) - 1)

/* A radar at the ego's place and heading, 1 at 10 m, with EFFECTS 12's receiver; another 50 m
 * ahead. */
struct bench {
    struct arena arena;
    struct frame frame;
    struct sensor sensor;
};

static int make_bench(void **state)
{
    struct bench *bench = calloc(1, sizeof *bench);
    assert_non_null(bench);
    bench->frame = (struct frame){.scene = "s", .ego = "ego", .seed = 1, .arena = &bench->arena};
    *list_add(&bench->frame.objects, &bench->arena) = (struct object){.id = "ego", .class = "car"};
    *list_add(&bench->frame.objects, &bench->arena) =
        (struct object){.id = "other", .class = "car", .x_m = 50};
    bench->sensor = (struct sensor){.name = "radar",
                                    .carrier_hz = 76.5e9,
                                    .field_of_view_rad = PI / 2,
                                    .polarization = POLARIZATION_VERTICAL,
                                    .calibration_ercs = 1,
                                    .calibration_range_m = 10,
                                    .exponent = 2,
                                    .range_floor_m = 0.5,
                                    .cell_range_m = 1,
                                    .cell_range_rate_mps = 1};
    suite_derive(&bench->sensor);
    *state = bench;
    return 0;
}

static int remove_bench(void **state)
{
    struct bench *bench = *state;
    arena_free(&bench->arena);
    free(bench);
    return 0;
}

static struct interferer *add_interferer(struct bench *bench, const char *object)
{
    struct interferer *other = list_add(&bench->frame.conditions.interferers, &bench->arena);
    *other = (struct interferer){object, 33, 7.5e12, 1};
    bench->sensor.receiver_bandwidth_hz = 1e7;
    bench->sensor.noise_figure_db = 12;
    bench->sensor.antenna_gain_dbi = 20;
    bench->sensor.chirp_slope_hzps = 7.5e12;
    bench->sensor.chirp_s = 2e-5;
    return other;
}

static struct received_echo ray_of(const struct bench *bench, uint64_t effects, double range_m)
{
    struct echo echo = {.sensor = "radar",
                        .id.object = "other",
                        .id.reflector = "r",
                        .range_m = range_m,
                        .range_rate_mps = 45,
                        .ercs = range_m * range_m / 100};
    struct reception reception = received_echo_begin(&bench->frame, &bench->sensor, effects);
    return received_echo_of(&reception, &echo);
}

static double floor_db(const struct bench *bench)
{
    return 10 * log10(received_echo_begin(&bench->frame, &bench->sensor, EVERYTHING).interference);
}

static void only_what_a_document_describes_is_received(void **state)
{
    struct bench *bench = *state;
    struct sensor *sensor = &bench->sensor;
    struct conditions *conditions = &bench->frame.conditions;
    assert_true(received_echo_described(&bench->frame, sensor) == 0);
    struct received_echo plain = ray_of(bench, EVERYTHING, 100);
    assert_close(plain.amplitude, 1, 1e-15);
    assert_true(plain.effects == 0 && plain.phase_rad == 0);
    uint64_t expected = 0;
    static const enum effect order[] = {EFFECT_FLUCTUATION, EFFECT_RAIN,      EFFECT_FOG,
                                        EFFECT_AMBIGUITY,   EFFECT_AMBIGUITY, EFFECT_INTERFERENCE,
                                        EFFECT_COHERENCE};
    for (int i = 0; i < 7; i++) {
        expected |= EFFECT_BIT(order[i]);
        sensor->fluctuation = FLUCTUATION_SWERLING_1;
        conditions->rain_mmph = i >= 1 ? 25 : 0;
        conditions->fog_gpm3 = i >= 2 ? 0.5 : 0;
        sensor->unambiguous_rate_mps = i >= 3 ? 24.5 : 0;
        sensor->unambiguous_range_m = i >= 4 ? 60 : 0;
        if (i == 5)
            add_interferer(bench, "other");
        sensor->cell_phase = i >= 6 ? CELL_RANDOM_PHASE : CELL_IN_PHASE;
        assert_true(received_echo_described(&bench->frame, sensor) == expected);
        assert_true(received_echo_begin(&bench->frame, sensor, EVERYTHING).effects == expected);
    }
    sensor->unambiguous_rate_mps = 0;
    assert_true(received_echo_described(&bench->frame, sensor) == expected);
    sensor->receiver_bandwidth_hz = 0;
    assert_true(received_echo_described(&bench->frame, sensor) ==
                (expected & ~EFFECT_BIT(EFFECT_INTERFERENCE)));
}

/* EFFECTS 13 at 100 m: 2.190804 dB in rain, 0.311546 in fog; a draw of its own address. */
static void factors_multiply_in_their_order_and_ranges_fold_last(void **state)
{
    struct bench *bench = *state;
    struct sensor *sensor = &bench->sensor;
    sensor->fluctuation = FLUCTUATION_SWERLING_3;
    sensor->unambiguous_range_m = 60;
    sensor->unambiguous_rate_mps = 24.5;
    bench->frame.conditions.rain_mmph = 25;
    bench->frame.conditions.fog_gpm3 = 0.5;
    struct echo_id id = {.object = "other", .reflector = "r"};
    struct random_address address = draw_address_of(&bench->frame, "radar", id);
    double uniform[4];
    random_uniform(&address, RANDOM_FLUCTUATION, 0, uniform);
    double drawn = sqrt(-(log(uniform[0]) + log(uniform[1])) / 2);
    double rain = pow(10, -2.190804 / 20), fog = pow(10, -0.311546 / 20);
    const struct {
        uint64_t effects;
        double amplitude;
    } cases[] = {
        {EFFECT_BIT(EFFECT_FLUCTUATION), drawn},
        {EFFECT_BIT(EFFECT_RAIN), rain},
        {EFFECT_BIT(EFFECT_FOG), fog},
        {EFFECT_BIT(EFFECT_AMBIGUITY), 1},
        {EFFECT_BIT(EFFECT_RAIN) | EFFECT_BIT(EFFECT_FOG), rain * fog},
        {EFFECT_BIT(EFFECT_FLUCTUATION) | EFFECT_BIT(EFFECT_RAIN) | EFFECT_BIT(EFFECT_FOG) |
             EFFECT_BIT(EFFECT_AMBIGUITY),
         drawn * rain * fog},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct received_echo received = ray_of(bench, cases[i].effects, 100);
        bool folded = (cases[i].effects & EFFECT_BIT(EFFECT_AMBIGUITY)) != 0;
        assert_true(received.effects == cases[i].effects);
        assert_near(received.amplitude, cases[i].amplitude, 2e-7);
        assert_near(received.strength, received.amplitude, 1e-15);
        assert_close(received.range_m, folded ? 40 : 100, 0);
        assert_close(received.range_rate_mps, folded ? -4 : 45, 0);
        assert_close(received.echo.range_m, 100, 0);
        assert_close(received.echo.range_rate_mps, 45, 0);
    }
}

static void what_changes_nothing_has_no_label(void **state)
{
    struct bench *bench = *state;
    bench->sensor.fluctuation = FLUCTUATION_LOG_NORMAL;
    bench->sensor.fluctuation_sigma_db = 0;
    bench->sensor.unambiguous_range_m = 100.5;
    bench->sensor.unambiguous_rate_mps = 45.5;
    assert_true(ray_of(bench, EVERYTHING, 100).effects == 0);
    bench->sensor.unambiguous_range_m = 99.5;
    assert_true(ray_of(bench, EVERYTHING, 100).effects == EFFECT_BIT(EFFECT_AMBIGUITY));
}

/* EFFECTS 12: 40.8746 dB at 50 m with equal slopes, the difference of two printed figures. */
static void an_interferer_is_heard_where_it_stands(void **state)
{
    struct bench *bench = *state;
    struct interferer *other = add_interferer(bench, "other");
    struct object *object = frame_object(&bench->frame, "other");
    struct object *ego = frame_object(&bench->frame, "ego");
    assert_close(floor_db(bench), 40.8746, 2e-4);
    object->x_m = 100;
    assert_close(floor_db(bench), 40.8746 - 20 * log10(2), 2e-4);
    /* The same seen from a sensor ahead of an ego that is elsewhere and turned. */
    bench->sensor.mount_x_m = 2;
    bench->sensor.mount_y_m = 1;
    *ego = (struct object){.id = "ego", .class = "car", .x_m = 7, .y_m = -3, .yaw_rad = PI / 2};
    object->x_m = 6;
    object->y_m = 49;
    assert_close(floor_db(bench), 40.8746, 2e-4);
    bench->sensor.mount_yaw_rad = -PI / 2;
    object->x_m = 56;
    object->y_m = -1;
    assert_close(floor_db(bench), 40.8746, 2e-4);
    other->slope_hzps = -7.5e12;
    assert_close(floor_db(bench), 40.8746 + 10 * log10(2.0 / 30), 2e-4);
    other->hit_share = 0.05;
    assert_close(floor_db(bench), 40.8746 + 10 * log10(0.1 / 30), 2e-4);
}

/* MODEL 13: the pattern is two ways in amplitude, and so one way in power: .5513 at 30 degrees. */
static void the_antenna_counts_one_way(void **state)
{
    struct bench *bench = *state;
    add_interferer(bench, "other");
    struct object *object = frame_object(&bench->frame, "other");
    object->x_m = 50 * cos(PI / 6);
    object->y_m = 50 * sin(PI / 6);
    assert_close(floor_db(bench), 40.8746 + 10 * log10(0.5513), 6e-4);
}

/* The sensor looks ahead from 2 m behind the ego's centre. */
static void who_is_not_in_view_is_not_heard(void **state)
{
    struct bench *bench = *state;
    struct interferer *other = add_interferer(bench, "other");
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
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        other->object = cases[i].id;
        object->x_m = cases[i].x_m;
        object->y_m = cases[i].y_m;
        double heard = received_echo_begin(&bench->frame, &bench->sensor, EVERYTHING).interference;
        assert_int_equal(heard > 0, cases[i].heard);
    }
    uint64_t without = EVERYTHING & ~EFFECT_BIT(EFFECT_INTERFERENCE);
    assert_close(received_echo_begin(&bench->frame, &bench->sensor, without).interference, 0, 0);
}

static void phases_come_from_the_path_or_from_the_scan(void **state)
{
    struct bench *bench = *state;
    double eighth_m = 299792458 / 76.5e9 / 8;
    bench->sensor.cell_phase = CELL_PHASE_BY_PATH;
    double first = ray_of(bench, EVERYTHING, 50).phase_rad;
    double later = ray_of(bench, EVERYTHING, 50 + eighth_m).phase_rad;
    assert_close(remainder(later - first + PI / 2, 2 * PI), 0, 1e-9);
    bench->frame.frame = 1;
    assert_close(ray_of(bench, EVERYTHING, 50).phase_rad, first, 0);
    bench->sensor.cell_phase = CELL_RANDOM_PHASE;
    double drawn = ray_of(bench, EVERYTHING, 50).phase_rad;
    assert_close(ray_of(bench, EVERYTHING, 50 + eighth_m).phase_rad, drawn, 0);
    bench->frame.frame = 2;
    assert_true(fabs(ray_of(bench, EVERYTHING, 50).phase_rad - drawn) > 1e-9);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_bench, remove_bench)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(only_what_a_document_describes_is_received),
        TEST(factors_multiply_in_their_order_and_ranges_fold_last),
        TEST(what_changes_nothing_has_no_label),
        TEST(an_interferer_is_heard_where_it_stands),
        TEST(the_antenna_counts_one_way),
        TEST(who_is_not_in_view_is_not_heard),
        TEST(phases_come_from_the_path_or_from_the_scan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
