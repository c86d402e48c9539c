/* One scan for tests of effects. A radar at the ego's centre looks ahead; it receives an echo of
 * ERCS 1 at 10 m on boresight with amplitude 1. Another object is 50 m ahead. */
#pragma once

#include "check.h"

#include "base/units.h"
#include "effects/effect.h"

#define EVERY_EFFECT (EFFECT_BIT(EFFECT_COUNT) - 1)

struct effect_bench {
    struct frame frame;
    struct sensor sensor;
    struct effect_log log;
};

static inline struct effect_bench *make_effect_bench(void)
{
    static struct effect_bench bench;
    struct frame *frame = &bench.frame;
    *frame = (struct frame){.scene = "s", .ego = "ego", .seed = 1, .arena = check_arena()};
    *list_add(&frame->objects, check_arena()) = (struct object){.id = "ego", .class = "car"};
    *list_add(&frame->objects, check_arena()) =
        (struct object){.id = "other", .class = "car", .x_m = 50};
    *list_add(&frame->sensors.list, check_arena()) =
        (struct sensor_view){.name = "radar", .measured = true};
    bench.sensor = (struct sensor){.name = "radar",
                                   .carrier_hz = 76.5e9,
                                   .range_min_m = 1,
                                   .range_max_m = 200,
                                   .field_of_view_rad = PI / 2,
                                   .polarization = POLARIZATION_VERTICAL,
                                   .calibration_ercs = 1,
                                   .calibration_range_m = 10,
                                   .exponent = 2,
                                   .range_floor_m = 0.5,
                                   .cell_range_m = 1,
                                   .cell_range_rate_mps = 1};
    suite_derive(&bench.sensor);
    return &bench;
}

static inline struct echo effect_bench_echo(double range_m)
{
    return (struct echo){.sensor = "radar",
                         .id.object = "other",
                         .id.reflector = "r",
                         .range_m = range_m,
                         .range_rate_mps = -3,
                         .ercs = 1};
}

/* Begins a scan of the sensor, as its document's members are now, with a set of effects. The
 * bench's log has what the scan notes. */
static inline struct effect_scan effect_bench_begin(struct effect_bench *bench, uint64_t effects,
                                                    enum effect_home home)
{
    bench->log = (struct effect_log){0};
    const struct selection selection = {.allowed = effects, .log = &bench->log};
    suite_derive(&bench->sensor);
    return effect_begin(&bench->frame, &bench->sensor, &selection, home);
}

/* What one effect of the sensor makes of an echo with strength and amplitude 1. Sets labelled: is
 * the effect in the echo's label? */
static inline struct effect_reception effect_bench_receive(struct effect_bench *bench,
                                                           enum effect_id effect,
                                                           const struct echo *echo, bool *labelled)
{
    struct effect_scan scan = effect_bench_begin(bench, EFFECT_BIT(effect), EFFECT_HOME_SENSOR);
    struct effect_reception reception = {.echo = echo,
                                         .strength = 1,
                                         .amplitude = 1,
                                         .range_m = echo->range_m,
                                         .elevation_rad = echo->elevation_rad,
                                         .range_rate_mps = echo->range_rate_mps};
    uint64_t effects = effect_receive(&scan, &reception);
    assert_true((effects & ~EFFECT_BIT(effect)) == 0);
    *labelled = effects != 0;
    return reception;
}

/* The factor of one effect on the amplitude of an echo. The effect is in the label unless that
 * is 1.
 */
static inline double effect_bench_factor(struct effect_bench *bench, enum effect_id effect,
                                         const struct echo *echo)
{
    bool labelled;
    struct effect_reception reception = effect_bench_receive(bench, effect, echo, &labelled);
    assert_true(reception.strength == reception.amplitude);
    assert_true(labelled == (reception.amplitude != 1));
    assert_true(reception.range_m == echo->range_m && reception.phase_rad == 0);
    assert_true(reception.range_rate_mps == echo->range_rate_mps);
    return reception.amplitude;
}

/* The echoes that effects add to a list of one echo. */
static inline struct echo_span effect_bench_added(struct effect_bench *bench, uint64_t effects,
                                                  struct echo echo)
{
    bench->frame.echoes.count = 0;
    *list_add(&bench->frame.echoes, check_arena()) = echo;
    struct effect_scan scan = effect_bench_begin(bench, effects, EFFECT_HOME_SENSOR);
    return effect_added_echoes(&scan);
}

/* The draws of an echo's own address for one purpose. */
static inline void effect_bench_draw(const struct effect_bench *bench, const struct echo *echo,
                                     enum random_purpose purpose, uint32_t index, double uniform[4])
{
    struct random_address address =
        frame_draw_address_of(&bench->frame, bench->sensor.name, echo->id);
    random_uniform(&address, purpose, index, uniform);
}

#define EFFECT_TEST(name) TEST_FROM(make_effect_bench, struct effect_bench *bench, name)
