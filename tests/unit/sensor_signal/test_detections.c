#include "check.h"

#include "effects/effect.h"
#include "sensor/resolution_cell.h"
#include "sensor_signal/detections.h"

enum { SAMPLES = 32, REPETITIONS = 64 };

/* A spectrum made of point responses, cells of 1 m and 0.25 m/s, a threshold of 2, echoes on
 * boresight. */
struct bench {
    struct sensor sensor;
    struct signal_cube signal;
    struct range_doppler spectrum;
    struct margins margins;
    struct received_echo received_echoes[4];
    size_t count;
    struct arena *arena;
    struct frame frame;
};

static void begin(struct bench *bench)
{
    *bench = (struct bench){.arena = check_arena()};
    field_clear(&waveform_record, &bench->sensor.waveform);
    bench->sensor.name = "front";
    bench->sensor.carrier_hz = 76.5e9;
    bench->sensor.range_max_m = SAMPLES;
    bench->sensor.chirp_slope_hzps = 1e16;
    bench->sensor.cell_range_m = 1;
    bench->sensor.cell_range_rate_mps = 0.25;
    bench->sensor.threshold = 2;
    bench->sensor.antenna.pattern = ANTENNA_DIPOLE_PAIR;
    bench->sensor.angle_estimator = MONOPULSE_RATIO;
    bench->sensor.waveform.samples = SAMPLES;
    bench->sensor.waveform.repetitions = REPETITIONS;
    bench->signal = signal_cube_of(&bench->sensor, bench->arena);
    bench->frame.arena = bench->arena;
    bench->frame.sections = CARRY_ACCOUNT;
}

/* The strongest echo comes first. */
static void receive(struct bench *bench, const char *name, double range_m, double rate_mps,
                    double amplitude)
{
    bench->received_echoes[bench->count++] = (struct received_echo){
        .echo = {.id.object = name,
                 .id.reflector = "centre",
                 .range_m = range_m,
                 .range_rate_mps = rate_mps},
        .strength = amplitude,
        .amplitude = amplitude,
        .range_m = range_m,
        .range_rate_mps = rate_mps,
        .margins = &bench->margins,
    };
}

static void show(struct bench *bench, double range_m, double rate_mps, double amplitude)
{
    for (int row = 0; row < 2 * REPETITIONS; row++)
        for (int column = 0; column < 2 * SAMPLES; column++) {
            double size =
                point_response_value(POINT_RESPONSE_HANN,
                                     range_doppler_distance(column / 2., range_m, SAMPLES)) *
                point_response_value(
                    POINT_RESPONSE_HANN,
                    range_doppler_distance(row / 2., rate_mps / 0.25, REPETITIONS));
            bench->signal.spectrum[row * 2 * SAMPLES + column].re += amplitude * size;
        }
}

static struct detections sight(struct bench *bench)
{
    const struct effect_scan context = {.frame = &bench->frame, .sensor = &bench->sensor};
    const struct clustered_echoes received = {.echoes = bench->received_echoes,
                                              .count = bench->count};
    bench->spectrum = signal_cube_spectrum(&bench->signal, bench->arena);
    struct detections detections = detections_of(&bench->signal, &bench->spectrum, 0, &context);
    detections_label(&detections, &bench->frame, "test", &received);
    return detections;
}

static const char *leader_of(const struct detection *detection)
{
    return detection->cell.members.items[0].id.object;
}

TEST(an_echo_belongs_to_the_detection_that_shows_most_of_it)
{
    static struct bench bench;
    begin(&bench);
    receive(&bench, "far", 20.25, 1, 60);
    receive(&bench, "near", 10.5, 0, 50);
    receive(&bench, "beside", 10.75, 0, 10);
    for (size_t i = 0; i < bench.count; i++)
        show(&bench, bench.received_echoes[i].range_m, bench.received_echoes[i].range_rate_mps,
             bench.received_echoes[i].amplitude);
    struct detections seen = sight(&bench);
    assert_int_equal(seen.list.count, 2);
    assert_string_equal(leader_of(&seen.list.items[0]), "far");
    assert_int_equal(seen.list.items[0].cell.members.count, 1);
    assert_close(seen.list.items[0].range_m, 20.25, 0.005);
    assert_string_equal(leader_of(&seen.list.items[1]), "near");
    assert_int_equal(seen.list.items[1].cell.members.count, 2);
    assert_close(seen.list.items[1].cell.members.items[1].weight, 1. / 6, 1e-15);
    assert_int_equal(bench.frame.lost.count, 0);
}

/* The truth, in the label, does not tell a rate that the waveform cannot tell. */
TEST(without_a_second_train_range_rates_fold_in_target_and_cell)
{
    static struct bench bench;
    begin(&bench);
    receive(&bench, "fast", 10, -29.75, 50);
    receive(&bench, "slow", 10, 2.25, 40);
    show(&bench, 10, 2.25, 90);
    struct detections seen = sight(&bench);
    assert_int_equal(seen.list.count, 1);
    const struct detection *one = &seen.list.items[0];
    assert_close(one->range_rate_mps, 2.25, 1e-9);
    assert_close(one->cell.range_rate_mps, 2.25, 1e-9);
    assert_close(one->cell.members.items[0].range_rate_mps, -29.75, 0);
    assert_int_equal(one->cell.members.count, 2);
}

TEST(a_detection_without_an_echo_is_a_false_alarm_and_counted)
{
    static struct bench bench;
    begin(&bench);
    receive(&bench, "echo", 10, 0, 50);
    show(&bench, 10, 0, 50);
    show(&bench, 25, 3, 5);
    struct detections seen = sight(&bench);
    assert_int_equal(seen.list.count, 2);
    assert_int_equal(seen.list.items[1].cell.members.items[0].id.path, PATH_FALSE_ALARM);
    assert_int_equal(bench.frame.counts.count, 1);
    assert_int_equal(bench.frame.counts.items[0].paths.items[0].echoes, 1);
}

/* Peaks to both sides of an echo, each too far off to be its own. */
TEST(a_detection_that_an_echo_makes_half_of_has_its_label_too)
{
    static struct bench bench;
    begin(&bench);
    receive(&bench, "echo", 10.4, 0, 50);
    show(&bench, 9, 0, 20);
    show(&bench, 12, 0, 2.2);
    struct detections seen = sight(&bench);
    assert_int_equal(seen.list.count, 2);
    for (size_t i = 0; i < 2; i++)
        assert_string_equal(leader_of(&seen.list.items[i]), "echo");
    assert_int_equal(bench.frame.lost.count, 0);
}

TEST(echoes_without_a_detection_are_lost_for_their_reason)
{
    static struct bench bench;
    static const enum loss reasons[] = {LOSS_MASKED, LOSS_BELOW_FINAL, LOSS_BELOW_THRESHOLD};
    begin(&bench);
    receive(&bench, "strong", 10, 0, 1000);
    receive(&bench, "masked", 12, 0, 20);
    receive(&bench, "faded", 20, 0, 3);
    receive(&bench, "weak", 25, 0, 1);
    show(&bench, 10, 0, 1000);
    show(&bench, 12, 0, 20);
    show(&bench, 20, 0, 1);
    struct detections seen = sight(&bench);
    assert_int_equal(seen.list.count, 1);
    assert_int_equal(bench.frame.lost.count, 3);
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(frame_loss_of(bench.frame.lost.items[i].reason), reasons[i]);
    assert_close(bench.frame.lost.items[1].echoes.items[0].shortfall_db, 20 * log10(2), 1e-2);
    assert_close(bench.frame.lost.items[2].echoes.items[0].shortfall_db, 20 * log10(2), 1e-9);
}
