/* The signal itself instead of a model of its cells: samples of every receiver, transformed and
 * searched for peaks as a radar does it (MODEL 11.3). */
#include <fftw3.h>

#include "detections.h"
#include "run/suite_choice.h"
#include "sensor/scan.h"

/* FFTW takes its memory here, instead of in its own function of this name, which would abort the
 * program where there is none, and gives it back. A static library has both in one file. */
void *fftw_kernel_malloc(size_t size);
void fftw_kernel_free(void *memory);

void *fftw_kernel_malloc(size_t size)
{
    return memory_get(size);
}

void fftw_kernel_free(void *memory)
{
    memory_free(memory);
}

/* One sensor's signal and the transforms that turn it into a spectrum, in place. */
struct transform {
    struct signal_cube signal;
    fftw_plan over_range, over_rate; /* of pulses the former is NULL */
};

struct sensor_signal {
    struct suite_choice choice; /* first: its options are the stage's */
    LIST_OF(struct transform) transforms;
};

/* Transforms of a length, count of them: elements of one are stride apart, those of neighbours
 * apart. The exponent is positive. With these flags FFTW chooses its way by the sizes alone: not by
 * time that it measures, nor by addresses, nor by the vector unit of the CPU. */
static fftw_plan plan_of(struct phasor *first, size_t length, size_t count, size_t stride,
                         size_t apart)
{
    int lengths[] = {(int)length};
    fftw_complex *at = (fftw_complex *)first;
    return fftw_plan_many_dft(1, lengths, (int)count, at, NULL, (int)stride, (int)apart, at, NULL,
                              (int)stride, (int)apart, FFTW_BACKWARD,
                              FFTW_ESTIMATE | FFTW_UNALIGNED | FFTW_NO_SIMD);
}

static struct transform *transform_of(struct sensor_signal *own, const struct sensor *sensor,
                                      struct runner *runner)
{
    for (size_t i = 0; i < own->transforms.count; i++)
        if (own->transforms.items[i].signal.sensor == sensor)
            return &own->transforms.items[i];
    struct arena *arena = runner_arena(runner);
    struct transform *transform = list_add(&own->transforms, arena);
    struct signal_cube signal = signal_cube_of(sensor, arena);
    size_t kept = signal.range_cells, row = signal.row_cells;
    transform->signal = signal;
    if (signal.chirp_s != 0)
        transform->over_range = plan_of(signal.rows, row, signal.channels, 1, row);
    transform->over_rate =
        plan_of(signal.spectrum, SIGNAL_CUBE_PADDING * signal.repetitions, kept, kept, 1);
    return transform;
}

/* Receives all trains of a scan, and transforms the first to a spectrum. */
static void receive(const struct transform *transform, const struct signal_input *input)
{
    const struct signal_cube *signal = &transform->signal;
    size_t size = SIGNAL_CUBE_PADDING * signal->repetitions * signal->range_cells;
    for (size_t train = 0; train < (signal->second != NULL ? 2 : 1); train++)
        for (size_t repetition = 0; repetition < signal->repetitions; repetition++) {
            signal_cube_receive(signal, input, train, repetition);
            if (transform->over_range != NULL)
                fftw_execute(transform->over_range);
            signal_cube_store(signal, train, repetition);
        }
    for (size_t channel = 0; channel < signal->channels; channel++) {
        fftw_complex *at = (fftw_complex *)(signal->spectrum + channel * size);
        fftw_execute_dft(transform->over_rate, at, at);
    }
}

static void sense(struct frame *frame, const struct transform *transform,
                  const struct selection *selection)
{
    const struct signal_cube *signal = &transform->signal;
    const struct sensor *sensor = signal->sensor;
    struct effect_scan context = effect_begin(frame, sensor, selection, EFFECT_HOME_SENSOR);
    struct effect_scan noise = effect_begin(frame, sensor, selection, EFFECT_HOME_NOISE);
    context.receiving &= ~EFFECT_BIT(EFFECT_RANGE_MIGRATION); /* the samples have it */
    struct scan scan = scan_receive(&context);
    scan_account(&scan, frame, "sensor-signal");
    struct signal_input input =
        signal_cube_input(signal, &scan, effect_simulates(&noise, EFFECT_ANGLE_NOISE));
    receive(transform, &input);
    struct range_doppler spectrum = signal_cube_spectrum(signal, frame->arena);
    struct detections detections = detections_of(signal, &spectrum, input.sigma, &context);
    detections_label(&detections, frame, "sensor-signal", &scan.received);
    detections_list(&detections, frame, "sensor-signal", &noise);
    effects_count_scan(selection);
}

static int sensor_signal_step(void *state, struct frame *frame, struct runner *runner)
{
    struct sensor_signal *own = state;
    struct selection selection;
    const struct suite *suite = suite_choice_suite(&own->choice, frame, runner);
    if (suite == NULL || suite_choice_effects(&own->choice, frame, runner, &selection) != 0 ||
        suite_choice_read(frame, suite, &selection, runner) != 0)
        return -1;
    for (size_t i = 0; i < suite->sensors.count; i++) {
        const struct sensor *sensor = &suite->sensors.items[i];
        if (sensor->waveform.samples == 0)
            return diag_fail(runner_diag(runner), DIAG_CONFIG,
                             "sensor \"%s\" of \"%s\" has no waveform; the signal cannot be "
                             "simulated without one",
                             sensor->name, suite->name);
        if (frame_view(frame, sensor->name)->measured)
            sense(frame, transform_of(own, sensor, runner), &selection);
    }
    return 0;
}

static void sensor_signal_release(void *state)
{
    struct sensor_signal *own = state;
    for (size_t i = 0; i < own->transforms.count; i++) {
        fftw_destroy_plan(own->transforms.items[i].over_range);
        fftw_destroy_plan(own->transforms.items[i].over_rate);
    }
}

static const struct field sensor_signal_fields[] = {
    SUITE_CHOICE_AFTER_IDEAL,
    {0},
};

const struct stage stage_sensor_signal = {
    .name = "sensor-signal",
    .summary = "Simulate the signal, transform it, and list its peaks as targets.",
    .details =
        "Stands in for glint-sensor and glint-noise, accurate and slow. It makes the samples of "
        "chirps or pulses, by the sensor's waveform: every echo with its phase, in a sum and a "
        "delta channel or in the elements of an array, and thermal noise. It applies windows and "
        "the "
        "range-Doppler transform, finds peaks by CFAR, and interpolates their places between the "
        "bins. The angle comes from the channels. A second train of chirps or pulses resolves "
        "folded range rates. Noise and amplitudes are those of the two stages; the threshold is "
        "that of the CFAR.\n\n"
        "The FFTW library computes the transforms. One build of it gives the same bytes on every "
        "machine, fused or piped. Another version or another kind of CPU may change the last "
        "digits, which happens in no other stage.",
    .options = STAGE_OPTIONS(struct sensor_signal, sensor_signal_fields),
    .reads = PART_SENSORS | PART_ECHOES,
    .writes = PART_TARGETS | PART_LOST | PART_COUNTS | PART_VISIBILITY,
    .step = sensor_signal_step,
    .locate_fault = suite_choice_locate_fault,
    .release = sensor_signal_release,
};
