#include "check.h"

#include "base/units.h"
#include "radar/micro_doppler.h"
#include "sensor/scatterers.h"

enum { FRAMES = 2000 };

static const struct sensor sensor = {
    .name = "s",
    .range_min_m = 1,
    .range_max_m = 50,
    .field_of_view_rad = 1,
    .mount_z_m = 0.5,
    .micro_motion = true,
};

static const struct echo parent = {
    .sensor = "s",
    .id.object = "o",
    .id.reflector = "r",
    .range_m = 20,
    .range_rate_mps = -3,
    .ercs = 0.5,
    .moving_part = MOVING_WHEEL,
    .ground_rate_mps = 5,
    .heading_rad = 1,
};

struct playback {
    struct arena arena;
    struct object ego;
    struct sensor_view view;
    struct echo echo;
    struct frame frame;
};

static void prepare(struct playback *scene, struct echo echo, double per_m2)
{
    *scene = (struct playback){
        .ego = {.id = "ego", .vx_mps = 10},
        .view = {.name = "s", .measured = true},
        .echo = echo,
    };
    struct frame *frame = &scene->frame;
    *frame = (struct frame){.scene = "scene", .ego = "ego", .arena = &scene->arena};
    frame->conditions.clutter_per_m2 = per_m2;
    frame->conditions.clutter_ercs = 0.1;
    frame->objects.items = &scene->ego;
    frame->sensors.list.items = &scene->view;
    frame->echoes.items = &scene->echo;
    frame->objects.count = frame->sensors.list.count = frame->echoes.count = 1;
}

static struct echo_span scatter(struct playback *scene, uint64_t effects)
{
    struct reception reception = received_echo_begin(&scene->frame, &sensor, effects);
    return scatterers_of(&reception);
}

static void rates_of_parts_are_within_their_bounds(void **state)
{
    (void)state;
    static const struct {
        enum moving_part part;
        enum path path;
        enum effect effect;
        double slowest, fastest; /* in parts of the motion over ground */
        double least, most;      /* how many in all */
    } cases[] = {
        {MOVING_WHEEL, PATH_WHEEL, EFFECT_WHEELS, -1, 1, 2700, 3300},
        {MOVING_LIMBS, PATH_LIMB, EFFECT_LIMBS, -1, 1.5, 800, 1200},
    };
    for (size_t i = 0; i < 2; i++) {
        struct playback scene;
        struct echo moving = parent;
        size_t all = 0;
        moving.moving_part = cases[i].part;
        prepare(&scene, moving, 0);
        for (scene.frame.frame = 0; scene.frame.frame < FRAMES; scene.frame.frame++) {
            struct echo_span parts = scatter(&scene, UINT64_MAX);
            for (size_t j = 0; j < parts.count; j++) {
                assert_int_equal(parts.items[j].id.path, cases[i].path);
                assert_int_equal(parts.items[j].id.number, (int64_t)j + 1);
                assert_int_equal(parts.items[j].effects, EFFECT_BIT(cases[i].effect));
                double swing = (parts.items[j].range_rate_mps - parent.range_rate_mps) /
                               parent.ground_rate_mps;
                assert_true(swing >= cases[i].slowest - 1e-12 && swing <= cases[i].fastest + 1e-12);
            }
            all += parts.count;
            assert_int_equal(scatter(&scene, UINT64_MAX & ~EFFECT_BIT(cases[i].effect)).count, 0);
        }
        assert_in_range(all, (uintmax_t)cases[i].least, (uintmax_t)cases[i].most);
        arena_free(&scene.arena);
    }
}

static void what_does_not_move_along_the_sight_line_has_no_parts(void **state)
{
    (void)state;
    struct echo still = parent, plain = parent;
    still.ground_rate_mps = 0;
    plain.moving_part = MOVING_NONE;
    const struct echo echoes[] = {still, plain};
    for (size_t i = 0; i < 2; i++) {
        struct playback scene;
        prepare(&scene, echoes[i], 0);
        for (scene.frame.frame = 0; scene.frame.frame < FRAMES; scene.frame.frame++)
            assert_int_equal(scatter(&scene, UINT64_MAX).count, 0);
        arena_free(&scene.arena);
    }
}

static void clutter_is_bounded_and_the_rest_of_it_stays(void **state)
{
    (void)state;
    struct playback some, many;
    prepare(&some, (struct echo){.sensor = "s", .id.object = "o", .id.reflector = "r"}, 0.5);
    prepare(&many, some.echo, 10);
    struct echo_span few = scatter(&some, UINT64_MAX), most = scatter(&many, UINT64_MAX);
    assert_in_range(few.count, 500, 750);
    assert_int_equal(most.count, SCATTERERS_MOST_CLUTTER);
    for (size_t i = 0; i < few.count; i++) {
        const struct echo *one = &few.items[i], *other = &most.items[i];
        assert_int_equal(one->id.number, other->id.number);
        assert_true(one->range_m == other->range_m && one->azimuth_rad == other->azimuth_rad);
        assert_close(one->range_rate_mps, -10 * cos(one->azimuth_rad), 1e-12);
        assert_true(fabs(one->azimuth_rad) < 0.5 && one->range_m >= 1 && one->range_m <= 50);
    }
    arena_free(&some.arena);
    arena_free(&many.arena);
}

static void a_sensor_that_does_not_measure_has_no_clutter(void **state)
{
    (void)state;
    struct playback scene;
    prepare(&scene, parent, 0.5);
    scene.view.measured = false;
    scene.frame.echoes.count = 0;
    assert_int_equal(scatter(&scene, UINT64_MAX).count, 0);
    arena_free(&scene.arena);
}

static void the_road_needs_a_height(void **state)
{
    (void)state;
    struct sensor radar = sensor;
    struct playback scene;
    radar.carrier_hz = 76.5e9;
    radar.amplitude_law = (struct radar_equation){.law = RADAR_POWER_LAW,
                                                  .exponent = 2,
                                                  .calibration_ercs = 1,
                                                  .calibration_range_m = 10,
                                                  .range_floor_m = 1,
                                                  .threshold = 1};
    prepare(&scene, parent, 0);
    scene.frame.conditions.road = ROAD_CONCRETE;
    struct echo high = parent, extended = parent;
    high.height_m = extended.height_m = 0.6;
    extended.extent_m = 0.6;
    scene.echo = high;
    struct reception reception = received_echo_begin(&scene.frame, &radar, UINT64_MAX);
    struct received_echo flat = received_echo_of(&reception, &parent),
                         one = received_echo_of(&reception, &high),
                         mean = received_echo_of(&reception, &extended);
    assert_int_equal(flat.effects & EFFECT_BIT(EFFECT_TWO_RAY), 0);
    assert_true((one.effects & EFFECT_BIT(EFFECT_TWO_RAY)) != 0);
    assert_true(mean.amplitude > flat.amplitude && mean.amplitude < sqrt(6) * flat.amplitude);
    assert_true(one.amplitude != mean.amplitude && one.amplitude <= 4 * flat.amplitude);
    scene.echo = parent;
    assert_int_equal(received_echo_described(&scene.frame, &radar) & EFFECT_BIT(EFFECT_TWO_RAY), 0);
    arena_free(&scene.arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rates_of_parts_are_within_their_bounds),
        cmocka_unit_test(what_does_not_move_along_the_sight_line_has_no_parts),
        cmocka_unit_test(clutter_is_bounded_and_the_rest_of_it_stays),
        cmocka_unit_test(a_sensor_that_does_not_measure_has_no_clutter),
        cmocka_unit_test(the_road_needs_a_height),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
