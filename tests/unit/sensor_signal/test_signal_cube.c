#include "check.h"

#include "sensor/scan.h"
#include "support/array_sensor.h"
#include "support/signal_transform.h"

#define PI 3.14159265358979323846

enum { SAMPLES = 32, REPETITIONS = 16 };

/* A sensor at 76.5 GHz with cells of 1 m and 0.5 m/s; A_ref is 1 at every range, so that amplitude
 * is ERCS. */
static struct sensor radar(enum waveform_kind kind, enum point_response window, size_t elements)
{
    struct sensor sensor = {
        .name = "front",
        .carrier_hz = 76.5e9,
        .range_max_m = SAMPLES,
        .cell_range_m = 1,
        .cell_range_rate_mps = 0.5,
        .antenna = {.pattern = ANTENNA_DIPOLE_PAIR, .phase = PHASE_CENTRE},
        .waveform = {.kind = kind,
                     .samples = SAMPLES,
                     .repetitions = REPETITIONS,
                     .window = window},
    };
    if (elements > 0)
        array_sensor_add(&sensor, elements, 0.5);
    return sensor;
}

static struct received_echo ray_at(const struct sensor *sensor, double range_m, double rate_mps,
                                   double azimuth_rad, double phase_rad)
{
    double gain = antenna_gain(&sensor->antenna, azimuth_rad);
    return (struct received_echo){
        .echo = {.azimuth_rad = azimuth_rad, .range_rate_mps = rate_mps},
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
    struct arena *arena;
};

static void begin(struct bench *bench, struct sensor sensor)
{
    *bench = (struct bench){.sensor = sensor, .arena = check_arena()};
    bench->signal = signal_cube_of(&bench->sensor, bench->arena);
}

static struct signal_input echo(struct bench *bench, struct received_echo received)
{
    return signal_cube_sources(&bench->signal, &received, 1, bench->arena);
}

/* One bin of one channel, by the sum that defines the transform, counted from the middle. Bins need
 * not be whole. */
static struct phasor bin(const struct bench *bench, const struct phasor *samples, double range,
                         double rate)
{
    bool pulses = bench->sensor.waveform.kind == WAVEFORM_PULSE;
    struct phasor sum = {0, 0};
    for (size_t m = 0; m < REPETITIONS; m++)
        for (size_t n = 0; n < SAMPLES; n++) {
            if (pulses && n != (size_t)range)
                continue;
            struct phasor sample = samples[m * SAMPLES + n];
            double turns = rate * ((double)m / REPETITIONS - 0.5) +
                           (pulses ? 0 : range * ((double)n / SAMPLES - 0.5));
            double c = cos(2 * PI * turns), s = sin(2 * PI * turns);
            sum.re += sample.re * c - sample.im * s;
            sum.im += sample.re * s + sample.im * c;
        }
    return sum;
}

/* The samples of one channel in the first train. */
static void receive(const struct bench *bench, const struct signal_input *input, size_t channel,
                    struct phasor samples[REPETITIONS * SAMPLES])
{
    for (size_t m = 0; m < REPETITIONS; m++) {
        signal_cube_receive(&bench->signal, input, 0, m);
        for (size_t n = 0; n < SAMPLES; n++)
            samples[m * SAMPLES + n] = bench->signal.rows[channel * bench->signal.row_cells + n];
    }
}

static struct phasor bin_of(const struct bench *bench, const struct signal_input *input,
                            size_t channel, double range, double rate)
{
    struct phasor samples[REPETITIONS * SAMPLES];
    receive(bench, input, channel, samples);
    return bin(bench, samples, range, rate);
}

static double size_of(struct phasor value)
{
    return hypot(value.re, value.im);
}

/* Around a standing echo, every bin of the sum channel is amplitude times point responses, but for
 * the finite number of samples. */
TEST(a_standing_echo_has_the_point_response_of_its_window)
{
    for (int window = POINT_RESPONSE_HANN; window <= POINT_RESPONSE_RECTANGULAR; window++) {
        struct bench bench;
        begin(&bench, radar(WAVEFORM_CHIRP, (enum point_response)window, 0));
        struct signal_input input = echo(&bench, ray_at(&bench.sensor, 10.3, 0, 0.1, 1));
        double amplitude = 3 * antenna_gain(&bench.sensor.antenna, 0.1);
        for (int range = 8; range <= 12; range++)
            for (int rate = -1; rate <= 1; rate++)
                assert_close(
                    size_of(bin_of(&bench, &input, 0, range, rate)),
                    amplitude *
                        fabs(point_response_value((enum point_response)window, range - 10.3) *
                             point_response_value((enum point_response)window, rate)),
                    0.004 * amplitude);
        assert_near(size_of(bin_of(&bench, &input, 0, 10.3, 0)), amplitude, 1e-12);
    }
}

/* The echo's own bin has the pointers of glint-sensor, turned by its phase. */
TEST(at_its_place_an_echo_has_its_pointers_and_its_phase)
{
    for (int kind = WAVEFORM_CHIRP; kind <= WAVEFORM_PULSE; kind++) {
        struct bench bench;
        begin(&bench, radar((enum waveform_kind)kind, POINT_RESPONSE_HANN, 0));
        struct signal_input input =
            echo(&bench, ray_at(&bench.sensor, kind == WAVEFORM_CHIRP ? 10 : 2.5, 0, -0.2, 1));
        struct antenna_pointers expected = antenna_pointers(&bench.sensor.antenna, -0.2);
        struct phasor sum = bin_of(&bench, &input, 0, 10, 0);
        struct phasor delta = bin_of(&bench, &input, 1, 10, 0);
        assert_close(size_of(sum), 3 * creal(expected.sum), 1e-12);
        assert_close(atan2(sum.im, sum.re), 1, 1e-12);
        assert_close(size_of(delta), 3 * fabs(cimag(expected.delta)), 1e-12);
        assert_true((delta.im * sum.re - delta.re * sum.im) * cimag(expected.delta) > 0);
    }
}

/* The phase of the chirp that the receiver hears, sent a delay ago, against the one that it sends,
 * in turns and in extended precision; less that at the instant of the measurement. */
static long double beat(long double carrier, long double slope, long double range, long double rate,
                        long double middle, long double since)
{
    const long double light = 299792458;
    long double delay = 2 * (range + rate * (middle + since)) / light, first = 2 * range / light;
    long double sent = carrier * (middle + since) + slope * since * since / 2;
    long double heard =
        carrier * (middle + since - delay) + slope * (since - delay) * (since - delay) / 2;
    return sent - heard - (carrier * first - slope * first * first / 2);
}

/* At 60 m/s each of 16 chirps of 240 us moves the echo by 15 mm. The samples of chirps that fall,
 * of which the second train's are made here, are sorted by frequency. */
TEST(every_sample_has_the_exact_phase_of_its_delay)
{
    for (size_t train = 0; train < 2; train++) {
        int way = train == 0 ? 1 : -1;
        struct bench bench;
        struct sensor sensor = radar(WAVEFORM_CHIRP, POINT_RESPONSE_RECTANGULAR, 0);
        long double interval = 299792458 / 76.5e9L / (2 * 0.5L) / REPETITIONS;
        long double slope = way * 299792458 / 2.L / interval;
        sensor.waveform.stagger = 5;
        sensor.chirp_slope_hzps = (double)slope;
        begin(&bench, sensor);
        struct signal_input input = echo(&bench, ray_at(&bench.sensor, 20, -60, 0, 0.7));
        for (size_t m = 0; m < REPETITIONS; m += 5) {
            long double middle = train == 0 ? interval * ((long double)m - REPETITIONS / 2)
                                            : interval * (REPETITIONS / 2 + 1.2L * (long double)m);
            signal_cube_receive(&bench.signal, &input, train, m);
            for (size_t n = 0; n < SAMPLES; n++) {
                long double since = way * interval * ((long double)n / SAMPLES - 0.5L);
                double turns = (double)fmodl(-beat(76.5e9L, slope, 20, -60, middle, since), 1.0L);
                struct phasor sample = bench.signal.rows[n];
                double size = 3. / SAMPLES / REPETITIONS;
                assert_close(sample.re, size * cos(2 * PI * turns + 0.7), 1e-7 * size);
                assert_close(sample.im, size * sin(2 * PI * turns + 0.7), 1e-7 * size);
            }
        }
    }
}

/* A chirp of 1 m cells with a slope that couples half a bin with 2 m/s, 4 bins of rate. Over the
 * scan the echo moves symmetrically about its range. */
TEST(a_moving_echo_is_at_its_place_at_mid_scan)
{
    struct bench bench;
    struct sensor sensor = radar(WAVEFORM_CHIRP, POINT_RESPONSE_HANN, 0);
    sensor.chirp_slope_hzps = 2 * 76.5e9 * 2;
    double range, rate;
    begin(&bench, sensor);
    struct received_echo received = ray_at(&bench.sensor, 10, 2, 0, 0);
    struct signal_input input = echo(&bench, received);
    signal_cube_place(&bench.signal, &received, &range, &rate);
    assert_close(range, 10.5, 1e-12);
    assert_close(rate, 4, 1e-12);
    assert_near(size_of(bin_of(&bench, &input, 0, range, 4)), 3., 1e-3);
    for (int side = -1; side <= 1; side += 2) {
        assert_near(size_of(bin_of(&bench, &input, 0, range + side * 0.5, 4)), 3 * 0.848826, 4e-3);
        assert_near(size_of(bin_of(&bench, &input, 0, range, 4 + side * 0.5)), 3 * 0.848826, 4e-3);
    }
}

/* At 400 m/s it moves 1.57 m in a scan of 3.9 ms: each pulse by itself shows it sharply. */
TEST(a_fast_echo_moves_through_the_range_bins)
{
    struct bench bench;
    begin(&bench, radar(WAVEFORM_PULSE, POINT_RESPONSE_RECTANGULAR, 0));
    struct signal_input input = echo(&bench, ray_at(&bench.sensor, 3, 400, 0, 0));
    double wavelength_m = 299792458 / 76.5e9, walk_m = 400 * wavelength_m / (2 * 0.5);
    for (size_t m = 0; m < REPETITIONS; m++) {
        signal_cube_receive(&bench.signal, &input, 0, m);
        const struct phasor *row = bench.signal.rows;
        double range_m = 3 + walk_m * ((double)m / REPETITIONS - 0.5);
        struct phasor before = row[11], at = row[12], after = row[13];
        double bins = log(hypot(before.re, before.im)) - log(hypot(after.re, after.im));
        bins /= 2 * (log(hypot(before.re, before.im)) - 2 * log(hypot(at.re, at.im)) +
                     log(hypot(after.re, after.im)));
        assert_close((12 + bins) / 4, range_m, 1e-9);
    }
}

/* The curve of an element halves the amplitude 0.4 rad aside. */
TEST(elements_have_the_curve_of_the_antenna_and_the_phase_of_their_place)
{
    static const struct receiver_curve_row rows[] = {{-0.4, -6.0206}, {0, 0}, {0.4, -6.0206}};
    struct bench bench;
    struct sensor sensor = radar(WAVEFORM_CHIRP, POINT_RESPONSE_HANN, 4);
    sensor.antenna.curve = (struct receiver_curve){.rows = rows, .count = 3};
    begin(&bench, sensor);
    struct signal_input input = echo(&bench, ray_at(&bench.sensor, 10, 0, 0.4, 0));
    for (size_t element = 0; element < 4; element++) {
        struct phasor shown = bin_of(&bench, &input, element, 10, 0);
        double turns = 0.5 * ((double)element - 1.5) * sin(0.4);
        assert_close(shown.re, 1.5 * cos(2 * PI * turns), 1e-6);
        assert_close(shown.im, 1.5 * sin(2 * PI * turns), 1e-6);
    }
}

/* Makes the spectrum of the first train by the sums that define its transforms. */
static void transform(const struct signal_cube *signal, const struct signal_input *input)
{
    size_t rows = SIGNAL_CUBE_PADDING * REPETITIONS, kept = signal->range_cells;
    struct phasor at[REPETITIONS];
    for (size_t m = 0; m < REPETITIONS; m++) {
        signal_cube_receive(signal, input, 0, m);
        signal_transform_rows(signal);
        signal_cube_store(signal, 0, m);
    }
    for (size_t channel = 0; channel < signal->channels; channel++)
        for (size_t k = 0; k < kept; k++) {
            struct phasor *cells = signal->spectrum + channel * rows * kept + k;
            for (size_t m = 0; m < REPETITIONS; m++)
                at[m] = cells[m * kept];
            for (size_t l = 0; l < rows; l++)
                cells[l * kept] = signal_transform_sum(at, REPETITIONS, l);
        }
}

/* Of N elements d apart the beam towards another sine, x/(pi d) away, receives sin(N x)/(N sin x)
 * of an echo. */
TEST(the_beams_of_the_spectrum_have_the_array_factor)
{
    struct bench bench;
    struct sensor sensor = radar(WAVEFORM_CHIRP, POINT_RESPONSE_HANN, 8);
    sensor.field_of_view_rad = PI / 2;
    begin(&bench, sensor);
    const double azimuth_rad = 0.21, limit = sin(PI / 4);
    struct signal_input input = echo(&bench, ray_at(&bench.sensor, 10, 0, azimuth_rad, 0.7));
    transform(&bench.signal, &input);
    struct range_doppler spectrum = signal_cube_spectrum(&bench.signal, bench.arena);
    size_t cells = spectrum.range_cells * spectrum.rate_cells, cell = 20;
    assert_true(spectrum.beams > 8 && spectrum.first_cell == 0);
    for (size_t beam = 0; beam < spectrum.beams; beam++) {
        double sine = limit * (2 * (double)beam / (double)(spectrum.beams - 1) - 1);
        double x = PI * 0.5 * (sine - sin(azimuth_rad));
        double factor = sin(8 * x) / (8 * sin(x));
        assert_close(sqrt(spectrum.power[beam * cells + cell]), 3 * fabs(factor), 1e-9);
    }
}

static struct signal_input noise(uint64_t frame, double sigma)
{
    return (struct signal_input){.address = {1, 2, frame, 3, 4}, .sigma = sigma};
}

/* The mean power of many bins far apart is sigma^2 in each channel, times the elements of an array.
 * 5 % are five standard errors of 10,000 independent values. */
TEST(noise_has_the_sensors_rms_after_windows_and_transforms)
{
    static const struct {
        enum waveform_kind kind;
        enum point_response window;
        size_t elements;
    } cases[] = {{WAVEFORM_CHIRP, POINT_RESPONSE_HANN, 0},
                 {WAVEFORM_CHIRP, POINT_RESPONSE_RECTANGULAR, 0},
                 {WAVEFORM_CHIRP, POINT_RESPONSE_HANN, 4},
                 {WAVEFORM_PULSE, POINT_RESPONSE_HANN, 0}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct bench bench;
        double power = 0;
        size_t count = 0;
        begin(&bench, radar(cases[i].kind, cases[i].window, cases[i].elements));
        for (uint64_t frame = 0; frame < 160; frame++) {
            struct signal_input input = noise(frame, 0.25);
            for (size_t channel = 0; channel < bench.signal.channels; channel++) {
                struct phasor samples[REPETITIONS * SAMPLES];
                receive(&bench, &input, channel, samples);
                for (int range = 0; range < SAMPLES; range += 8)
                    for (int rate = 0; rate < REPETITIONS; rate += 4, count++)
                        power += pow(size_of(bin(&bench, samples, range, rate)), 2);
            }
        }
        double elements = cases[i].elements > 0 ? (double)cases[i].elements : 1;
        assert_near(power / (double)count, 0.0625 * elements, 0.07);
    }
}

/* The noise of a matched receiver: the correlation of range bins is the pulse's point response. */
TEST(the_noise_of_pulses_is_correlated_as_their_point_response)
{
    struct bench bench;
    double sums[5] = {0};
    begin(&bench, radar(WAVEFORM_PULSE, POINT_RESPONSE_RECTANGULAR, 0));
    for (uint64_t row = 0; row < 400 * 2 * REPETITIONS; row++) {
        struct signal_input input = noise(row / REPETITIONS, 1);
        signal_cube_receive(&bench.signal, &input, 0, row % REPETITIONS);
        const struct phasor *samples = bench.signal.rows;
        for (size_t n = 0; n < SAMPLES; n++)
            for (size_t away = 0; away < 5; away++) {
                const struct phasor *other = &samples[(n + away) % SAMPLES];
                sums[away] += samples[n].re * other->re + samples[n].im * other->im;
            }
    }
    for (size_t away = 1; away < 5; away++)
        assert_close(sums[away] / sums[0], point_response_value(POINT_RESPONSE_PULSE, (double)away),
                     0.01);
}
