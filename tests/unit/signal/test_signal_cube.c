#include "check.h"

#include <stdlib.h>

#include "sensor/scan.h"
#include "signal/signal_cube.h"

#define PI 3.14159265358979323846
#define DEGREE (PI / 180)

enum { SAMPLES = 32, REPETITIONS = 16 };

/* A sensor at 76.5 GHz with cells of 1 m and 0.5 m/s; A_ref is 1 at every range, so that amplitude
 * is ERCS. */
static struct sensor radar(enum waveform_kind kind, enum point_response window, int64_t elements)
{
    return (struct sensor){
        .name = "front",
        .carrier_hz = 76.5e9,
        .cell_range_m = 1,
        .cell_range_rate_mps = 0.5,
        .antenna = {.pattern = ANTENNA_DIPOLE_PAIR, .phase = PHASE_CENTRE},
        .waveform = {.kind = kind,
                     .samples = SAMPLES,
                     .repetitions = REPETITIONS,
                     .elements = elements,
                     .spacing = 0.5,
                     .window = window},
    };
}

static struct received_echo ray_at(const struct sensor *sensor, double range_m, double rate_mps,
                                   double azimuth_rad, double phase_rad)
{
    double gain = antenna_gain(&sensor->antenna, azimuth_rad);
    return (struct received_echo){
        .echo = {.azimuth_rad = azimuth_rad},
        .strength = 3,
        .amplitude = 3 * gain,
        .range_m = range_m,
        .range_rate_mps = rate_mps,
        .phase_rad = phase_rad,
    };
}

struct bench {
    struct sensor sensor;
    struct signal_cube signal;
    struct arena arena;
};

static void begin(struct bench *bench, struct sensor sensor)
{
    *bench = (struct bench){.sensor = sensor};
    bench->signal = signal_cube_of(&bench->sensor);
    bench->signal.cube =
        arena_get(&bench->arena, signal_cube_size(&bench->signal) * sizeof(struct phasor));
    bench->signal.row = arena_get(&bench->arena, SAMPLES * sizeof(struct phasor));
}

static void add(struct bench *bench, struct received_echo received)
{
    signal_cube_add(&bench->signal, &received, 1, &bench->arena);
}

/* One bin of one channel, by the sum that defines the transform. Bins need not be whole. */
static struct phasor bin(const struct bench *bench, size_t channel, double range, double rate)
{
    bool pulses = bench->sensor.waveform.kind == WAVEFORM_PULSE;
    const struct phasor *cube = bench->signal.cube + channel * SAMPLES * REPETITIONS;
    struct phasor sum = {0, 0};
    for (size_t m = 0; m < REPETITIONS; m++)
        for (size_t n = 0; n < SAMPLES; n++) {
            if (pulses && n != (size_t)range)
                continue;
            double turns =
                rate * (double)m / REPETITIONS + (pulses ? 0 : range * (double)n / SAMPLES);
            double c = cos(2 * PI * turns), s = sin(2 * PI * turns);
            sum.re += cube[m * SAMPLES + n].re * c - cube[m * SAMPLES + n].im * s;
            sum.im += cube[m * SAMPLES + n].re * s + cube[m * SAMPLES + n].im * c;
        }
    return sum;
}

static double size_of(struct phasor value)
{
    return hypot(value.re, value.im);
}

/* Around a standing echo, every bin of the sum channel is amplitude times point responses, but for
 * the finite number of samples. */
static void a_standing_echo_has_the_point_response_of_its_window(void **state)
{
    (void)state;
    for (int window = POINT_RESPONSE_HANN; window <= POINT_RESPONSE_RECTANGULAR; window++) {
        struct bench bench;
        begin(&bench, radar(WAVEFORM_CHIRP, (enum point_response)window, 0));
        add(&bench, ray_at(&bench.sensor, 10.3, 0, 0.1, 1));
        signal_cube_apply_windows(&bench.signal);
        double amplitude = 3 * antenna_gain(&bench.sensor.antenna, 0.1);
        for (int range = 8; range <= 12; range++)
            for (int rate = -1; rate <= 1; rate++)
                assert_close(
                    size_of(bin(&bench, 0, range, rate)),
                    amplitude *
                        fabs(point_response_value((enum point_response)window, range - 10.3) *
                             point_response_value((enum point_response)window, rate)),
                    0.004 * amplitude);
        assert_near(size_of(bin(&bench, 0, 10.3, 0)), amplitude, 1e-12);
        arena_free(&bench.arena);
    }
}

/* The echo's own bin has the pointers of glint-sensor, turned by its phase. */
static void at_its_place_an_echo_has_its_pointers_and_its_phase(void **state)
{
    (void)state;
    for (int kind = WAVEFORM_CHIRP; kind <= WAVEFORM_PULSE; kind++) {
        struct bench bench;
        begin(&bench, radar((enum waveform_kind)kind, POINT_RESPONSE_HANN, 0));
        add(&bench, ray_at(&bench.sensor, kind == WAVEFORM_CHIRP ? 10 : 2.5, 0, -0.2, 1));
        signal_cube_apply_windows(&bench.signal);
        struct antenna_pointers expected = antenna_pointers(&bench.sensor.antenna, -0.2);
        struct phasor sum = bin(&bench, 0, 10, 0), delta = bin(&bench, 1, 10, 0);
        assert_close(size_of(sum), 3 * creal(expected.sum), 1e-12);
        assert_close(atan2(sum.im, sum.re), 1, 1e-12);
        assert_close(size_of(delta), 3 * fabs(cimag(expected.delta)), 1e-12);
        assert_true((delta.im * sum.re - delta.re * sum.im) * cimag(expected.delta) > 0);
        arena_free(&bench.arena);
    }
}

/* 2 m/s are 4 bins; over the scan the echo moves symmetrically about its range. */
static void a_moving_echo_is_at_its_rate_and_its_range_at_mid_scan(void **state)
{
    (void)state;
    struct bench bench;
    begin(&bench, radar(WAVEFORM_CHIRP, POINT_RESPONSE_HANN, 0));
    add(&bench, ray_at(&bench.sensor, 10, 2, 0, 0));
    signal_cube_apply_windows(&bench.signal);
    assert_near(size_of(bin(&bench, 0, 10, 4)), 3., 1e-3);
    assert_near(size_of(bin(&bench, 0, 10.5, 4)), size_of(bin(&bench, 0, 9.5, 4)), 2e-3);
    assert_near(size_of(bin(&bench, 0, 10, 4.5)), size_of(bin(&bench, 0, 10, 3.5)), 2e-3);
    arena_free(&bench.arena);
}

/* At 400 m/s it moves 1.57 m in a scan of 3.9 ms: each chirp by itself shows it sharply. */
static void a_fast_echo_moves_through_the_range_bins(void **state)
{
    (void)state;
    struct bench bench;
    begin(&bench, radar(WAVEFORM_PULSE, POINT_RESPONSE_RECTANGULAR, 0));
    add(&bench, ray_at(&bench.sensor, 3, 400, 0, 0));
    double wavelength_m = 299792458 / 76.5e9, walk_m = 400 * wavelength_m / (2 * 0.5);
    for (size_t m = 0; m < REPETITIONS; m++) {
        const struct phasor *row = bench.signal.cube + m * SAMPLES;
        double range_m = 3 + walk_m * ((double)m / REPETITIONS - 0.5);
        struct phasor before = row[11], at = row[12], after = row[13];
        double bins = log(hypot(before.re, before.im)) - log(hypot(after.re, after.im));
        bins /= 2 * (log(hypot(before.re, before.im)) - 2 * log(hypot(at.re, at.im)) +
                     log(hypot(after.re, after.im)));
        assert_close((12 + bins) / 4, range_m, 1e-9);
    }
    arena_free(&bench.arena);
}

static void elements_of_a_row_have_the_sum_pattern_and_their_phase(void **state)
{
    (void)state;
    struct bench bench;
    begin(&bench, radar(WAVEFORM_CHIRP, POINT_RESPONSE_HANN, 4));
    add(&bench, ray_at(&bench.sensor, 10, 0, 0.3, 0));
    signal_cube_apply_windows(&bench.signal);
    double amplitude = 3 * antenna_gain(&bench.sensor.antenna, 0.3);
    for (size_t element = 0; element < 4; element++) {
        struct phasor shown = bin(&bench, element, 10, 0);
        double turns = 0.5 * ((double)element - 1.5) * sin(0.3);
        assert_close(shown.re, amplitude * cos(2 * PI * turns), 1e-12);
        assert_close(shown.im, amplitude * sin(2 * PI * turns), 1e-12);
    }
    arena_free(&bench.arena);
}

/* The mean power of many bins far apart is sigma^2 in each channel, times the elements of a row. 5
 * % are five standard errors of 10,000 independent values. */
static void noise_has_the_sensors_rms_after_windows_and_transforms(void **state)
{
    (void)state;
    static const struct {
        enum waveform_kind kind;
        enum point_response window;
        int64_t elements;
    } cases[] = {{WAVEFORM_CHIRP, POINT_RESPONSE_HANN, 0},
                 {WAVEFORM_CHIRP, POINT_RESPONSE_RECTANGULAR, 0},
                 {WAVEFORM_CHIRP, POINT_RESPONSE_HANN, 4},
                 {WAVEFORM_PULSE, POINT_RESPONSE_HANN, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct bench bench;
        double power = 0;
        size_t count = 0;
        begin(&bench, radar(cases[i].kind, cases[i].window, cases[i].elements));
        for (uint64_t frame = 0; frame < 160; frame++) {
            const struct random_address address = {1, 2, frame, 3, 4};
            signal_cube_clear(&bench.signal);
            signal_cube_add_noise(&bench.signal, &address, 0.25);
            signal_cube_apply_windows(&bench.signal);
            for (size_t channel = 0; channel < bench.signal.channels; channel++)
                for (int range = 0; range < SAMPLES; range += 8)
                    for (int rate = 0; rate < REPETITIONS; rate += 4, count++)
                        power += pow(size_of(bin(&bench, channel, range, rate)), 2);
        }
        double elements = cases[i].elements > 0 ? (double)cases[i].elements : 1;
        assert_near(power / (double)count, 0.0625 * elements, 0.07);
        arena_free(&bench.arena);
    }
}

/* The noise of a matched receiver: the correlation of range bins is the pulse's point response. */
static void the_noise_of_pulses_is_correlated_as_their_point_response(void **state)
{
    (void)state;
    struct bench bench;
    double sums[5] = {0};
    begin(&bench, radar(WAVEFORM_PULSE, POINT_RESPONSE_HANN, 0));
    for (uint64_t frame = 0; frame < 400; frame++) {
        const struct random_address address = {1, 2, frame, 3, 4};
        signal_cube_clear(&bench.signal);
        signal_cube_add_noise(&bench.signal, &address, 1);
        for (size_t row = 0; row < 2 * REPETITIONS; row++)
            for (size_t n = 0; n < SAMPLES; n++)
                for (size_t away = 0; away < 5; away++) {
                    const struct phasor *samples = bench.signal.cube + row * SAMPLES;
                    const struct phasor *other = &samples[(n + away) % SAMPLES];
                    sums[away] += samples[n].re * other->re + samples[n].im * other->im;
                }
    }
    for (size_t away = 1; away < 5; away++)
        assert_close(sums[away] / sums[0], point_response_value(POINT_RESPONSE_PULSE, (double)away),
                     0.01);
    arena_free(&bench.arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_standing_echo_has_the_point_response_of_its_window),
        cmocka_unit_test(at_its_place_an_echo_has_its_pointers_and_its_phase),
        cmocka_unit_test(a_moving_echo_is_at_its_rate_and_its_range_at_mid_scan),
        cmocka_unit_test(a_fast_echo_moves_through_the_range_bins),
        cmocka_unit_test(elements_of_a_row_have_the_sum_pattern_and_their_phase),
        cmocka_unit_test(noise_has_the_sensors_rms_after_windows_and_transforms),
        cmocka_unit_test(the_noise_of_pulses_is_correlated_as_their_point_response),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
