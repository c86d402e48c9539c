/* How often noise passes the CFAR in a bin: as often as cfar_false_alarm says, before peaks are
 * picked.
 *
 * The probability is 0.01, which takes some seconds. With CASES=1 it is also the shipped one, for
 * at least 6 million bins of every waveform. */
#include "check.h"

#include "sensor_signal/signal_cube.h"
#include "support/array_sensor.h"

#define PI 3.14159265358979323846

/* In place, of a power of two, with a positive exponent: out = sum of in exp(+2 pi j k n/count). */
static void transform(struct phasor *values, size_t count, size_t stride, struct phasor *scratch)
{
    if (count == 1)
        return;
    transform(values, count / 2, 2 * stride, scratch);
    transform(values + stride, count / 2, 2 * stride, scratch);
    for (size_t k = 0; k < count / 2; k++) {
        double c = cos(2 * PI * (double)k / (double)count),
               s = sin(2 * PI * (double)k / (double)count);
        struct phasor even = values[2 * k * stride], odd = values[(2 * k + 1) * stride];
        struct phasor turned = {odd.re * c - odd.im * s, odd.re * s + odd.im * c};
        scratch[k] = (struct phasor){even.re + turned.re, even.im + turned.im};
        scratch[k + count / 2] = (struct phasor){even.re - turned.re, even.im - turned.im};
    }
    for (size_t k = 0; k < count; k++)
        values[k * stride] = scratch[k];
}

/* A shipped radar with a signal, and its variants. */
struct radar {
    const char *name;
    struct sensor sensor;
    size_t scans; /* of the long test */
};

static struct sensor lrr77(int64_t samples, int64_t repetitions, size_t elements, double spacing)
{
    struct sensor sensor = {
        .name = "front",
        .carrier_hz = 76.5e9,
        .range_max_m = samples == 128 ? 229 : 250,
        .field_of_view_rad = PI / 10,
        .cell_range_m = 1.79,
        .cell_range_rate_mps = 0.103,
        .waveform = {.kind = WAVEFORM_CHIRP, .samples = samples, .repetitions = repetitions},
    };
    if (elements > 0)
        array_sensor_add(&sensor, elements, spacing);
    return sensor;
}

static struct sensor srr24(void)
{
    return (struct sensor){
        .name = "left",
        .carrier_hz = 24.125e9,
        .range_max_m = 30,
        .field_of_view_rad = PI,
        .cell_range_m = 0.3,
        .cell_range_rate_mps = 0.5,
        .waveform = {.kind = WAVEFORM_PULSE, .samples = 416, .repetitions = 64},
    };
}

struct counts {
    double bins, passes, peaks, scans;
};

static void add_spectrum(const struct range_doppler *spectrum, const struct cfar *cfar,
                         struct counts *counts)
{
    size_t width = spectrum->range_cells, height = spectrum->rate_cells;
    for (size_t row = 0; row < height; row += spectrum->rate_padding)
        for (size_t column = 0; column < width; column += spectrum->range_padding) {
            bool passes = false;
            for (size_t beam = 0; beam < spectrum->beams; beam++) {
                const double *power = spectrum->power + beam * width * height + column;
                passes =
                    passes || power[row * width] >= cfar_threshold(cfar, power, height, width, row);
            }
            counts->bins++;
            counts->passes += passes;
        }
}

static void receive(const struct signal_cube *signal, uint64_t frame)
{
    size_t kept = signal->range_cells, height = SIGNAL_CUBE_PADDING * signal->repetitions;
    const struct signal_input noise = {.address = {1, 2, frame, 3, 4}, .sigma = 1};
    struct phasor scratch[8192];
    for (size_t m = 0; m < signal->repetitions; m++) {
        signal_cube_receive(signal, &noise, 0, m);
        for (size_t channel = 0; channel < signal->channels && signal->chirp_s != 0; channel++)
            transform(signal->rows + channel * signal->row_cells, signal->row_cells, 1, scratch);
        signal_cube_store(signal, 0, m);
    }
    for (size_t channel = 0; channel < signal->channels; channel++)
        for (size_t column = 0; column < kept; column++)
            transform(signal->spectrum + channel * height * kept + column, height, kept, scratch);
}

static struct counts measure(const struct sensor *sensor, size_t scans)
{
    struct counts counts = {.scans = (double)scans};
    struct signal_cube signal = signal_cube_of(sensor, check_arena());
    for (uint64_t frame = 0; frame < scans; frame++) {
        struct arena scan = {0};
        struct range_doppler_peak *peaks;
        receive(&signal, frame);
        struct range_doppler spectrum = signal_cube_spectrum(&signal, &scan);
        struct cfar cfar = waveform_cfar(&sensor->waveform, SIGNAL_CUBE_PADDING, spectrum.beams);
        add_spectrum(&spectrum, &cfar, &counts);
        counts.peaks += (double)range_doppler_peaks(&spectrum, &cfar, 0, &scan, &peaks);
        arena_free(&scan);
    }
    return counts;
}

static const struct {
    const char *name;
    enum point_response window;
    enum cfar_kind cfar;
} searches[] = {
    {"hann ordered", POINT_RESPONSE_HANN, CFAR_ORDERED},
    {"hann mean", POINT_RESPONSE_HANN, CFAR_MEAN},
    {"rectangular ordered", POINT_RESPONSE_RECTANGULAR, CFAR_ORDERED},
    {"rectangular mean", POINT_RESPONSE_RECTANGULAR, CFAR_MEAN},
};

static struct sensor searched(struct sensor sensor, size_t search, double probability)
{
    sensor.waveform.window = searches[search].window;
    sensor.waveform.cfar = searches[search].cfar;
    sensor.waveform.cfar_cells = 16;
    sensor.waveform.cfar_guard = 2;
    sensor.waveform.cfar_rank = 12;
    sensor.waveform.cfar_false_alarm = probability;
    return sensor;
}

/* At least 1,000 alarms, of which those of neighbours are not independent: 10 % are three standard
 * errors. Beams that share the probability have alarms in common, 13 % of them at 0.01. */
TEST(noise_passes_as_often_as_the_document_says)
{
    const struct sensor radars[] = {lrr77(128, 64, 0, 0), lrr77(64, 64, 4, 1.1), srr24()};
    for (size_t i = 0; i < 3; i++)
        for (size_t search = 0; search < 4; search++) {
            struct sensor sensor = searched(radars[i], search, 1e-2);
            if (sensor.beams.count > 0)
                sensor.range_max_m = 100;
            struct counts counts = measure(&sensor, 30);
            double rate = counts.passes / counts.bins;
            assert_true(counts.bins > 1e5);
            assert_near(rate, sensor.beams.count > 0 ? 0.87e-2 : 1e-2, 0.1);
        }
}

/* Prints the rates of the shipped waveforms. Only where CASES asks for it, as it takes minutes. */
TEST(noise_passes_shipped_waveforms_as_often_as_their_documents_say)
{
    if (check_cases(0) == 0)
        return;
    const struct radar radars[] = {{"lrr77-signal-small", lrr77(128, 64, 0, 0), 1500},
                                   {"lrr77-signal-medium", lrr77(256, 128, 4, 1.1), 400},
                                   {"lrr77-signal-large", lrr77(512, 256, 8, 0.55), 160},
                                   {"srr24-signal", srr24(), 1000}};
    bool all_near = true;
    printf("radar                 search                bins      alarms a bin   peaks a scan\n");
    for (size_t i = 0; i < 4; i++)
        for (size_t search = 0; search < 4; search++) {
            struct sensor sensor = searched(radars[i].sensor, search, 1e-4);
            sensor.waveform.stagger = i == 0 ? 20 : i == 1 ? 10 : i == 2 ? 5 : 4;
            struct counts counts = measure(&sensor, radars[i].scans);
            double rate = counts.passes / counts.bins;
            all_near = all_near && fabs(rate / 1e-4 - 1) < 0.1;
            printf("%-20s  %-20s  %9.0f  %.3e      %.2f\n", radars[i].name, searches[search].name,
                   counts.bins, rate, counts.peaks / counts.scans);
            fflush(stdout);
        }
    assert_true(all_near);
}
