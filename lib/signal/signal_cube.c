#include "signal/signal_cube.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#include "base/elementary.h"
#include "base/units.h"
#include "frame/draw_address.h"
#include "noise/false_alarm_cells.h"
#include "radar/interferer.h"
#include "sensor/scan.h"

/* Beyond this many bins a pulse is below 2^-36 of its peak. */
#define PULSE_REACH 12
/* Reach, in bins, of the receiver's filter for pulses, 2^-(k^2/2), whose autocorrelation is their
 * point response. */
#define FILTER_REACH 7

static bool is_pulsed(const struct signal_cube *signal)
{
    return signal->range_response == POINT_RESPONSE_PULSE;
}

struct signal_cube signal_cube_of(const struct sensor *sensor)
{
    const struct waveform *waveform = &sensor->waveform;
    return (struct signal_cube){
        .sensor = sensor,
        .samples = (size_t)waveform->samples,
        .repetitions = (size_t)waveform->repetitions,
        .channels = waveform->elements > 0 ? (size_t)waveform->elements : 2,
        .range_response =
            waveform->kind == WAVEFORM_PULSE ? POINT_RESPONSE_PULSE : waveform->window,
        .range_step_m = waveform_range_step_m(waveform, sensor->cell_range_m),
        .rate_step_mps = sensor->cell_range_rate_mps,
        .array = {(size_t)waveform->elements, waveform->spacing},
    };
}

size_t signal_cube_size(const struct signal_cube *signal)
{
    return signal->channels * signal->repetitions * signal->samples;
}

void signal_cube_clear(const struct signal_cube *signal)
{
    memset(signal->cube, 0, signal_cube_size(signal) * sizeof *signal->cube);
}

static struct phasor phasor_of(double amplitude, double turns)
{
    struct elementary_sincos phase = elementary_sincos_turns(turns);
    return (struct phasor){amplitude * phase.cos, amplitude * phase.sin};
}

static struct phasor times(struct phasor a, struct phasor b)
{
    return (struct phasor){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

/* An echo as the channels receive it, and its place in bins. */
struct source {
    struct phasor weight[BEAMFORMING_MOST_ELEMENTS];
    double turns, range, rate, range_walk;
};

static void weigh_channels(const struct signal_cube *signal, const struct received_echo *received,
                           struct phasor *weight)
{
    struct antenna_pointers pointers =
        antenna_pointers(&signal->sensor->antenna, received->echo.azimuth_rad);
    double sine = elementary_sin(received->echo.azimuth_rad);
    weight[0] = (struct phasor){received->strength * creal(pointers.sum),
                                received->strength * cimag(pointers.sum)};
    weight[1] = (struct phasor){received->strength * creal(pointers.delta),
                                received->strength * cimag(pointers.delta)};
    for (size_t element = 0; element < signal->array.elements; element++) {
        struct phasor response = beamforming_element_response(&signal->array, sine, element);
        weight[element] =
            (struct phasor){received->amplitude * response.re, received->amplitude * response.im};
    }
}

static struct source source_of(const struct signal_cube *signal,
                               const struct received_echo *received)
{
    double scan_s = units_wavelength_m(signal->sensor->carrier_hz) / (2 * signal->rate_step_mps);
    struct source source = {
        .turns = received->phase_rad / (2 * PI),
        .range = received->range_m / signal->range_step_m,
        .rate = received->range_rate_mps / signal->rate_step_mps,
        .range_walk = received->range_rate_mps * scan_s / signal->range_step_m,
    };
    weigh_channels(signal, received, source.weight);
    return source;
}

/* The samples of one repetition of chirps: a tone by rotation, in CHAINS independent chains, since
 * each sample waits for the one it comes from. n turns leave an error of at most n/CHAINS ulp. */
static void chirp(struct phasor *tone, size_t count, double cells, struct phasor first)
{
    enum { CHAINS = 4 };
    double turns = -cells / (double)count;
    struct phasor step = phasor_of(1, CHAINS * turns);
    for (size_t n = 0; n < count; n++)
        tone[n] = n < CHAINS ? times(first, phasor_of(1, cells / 2 + (double)n * turns))
                             : times(tone[n - CHAINS], step);
}

static void pulse(struct phasor *tone, size_t count, double bins, struct phasor first)
{
    double begin = elementary_max(ceil(bins - PULSE_REACH), 0), end = floor(bins + PULSE_REACH);
    memset(tone, 0, count * sizeof *tone);
    for (double n = begin; n <= end && n < (double)count; n++) {
        double size = point_response_value(POINT_RESPONSE_PULSE, n - bins);
        tone[(size_t)n] = (struct phasor){size * first.re, size * first.im};
    }
}

/* Both parts of a complex number at once, as most of the time is spent here. Each lane rounds as it
 * would alone. */
typedef double lanes __attribute__((vector_size(2 * sizeof(double))));

static void add(struct phasor *row, const struct phasor *tone, size_t count, struct phasor weight)
{
    const lanes along = {weight.re, weight.im}, across = {-weight.im, weight.re};
    for (size_t n = 0; n < count; n++) {
        lanes sum;
        memcpy(&sum, &row[n], sizeof sum);
        sum += tone[n].re * along + tone[n].im * across;
        memcpy(&row[n], &sum, sizeof sum);
    }
}

static void add_source(const struct signal_cube *signal, const struct source *source, size_t m)
{
    size_t size = signal->repetitions * signal->samples;
    double part = (double)m / (double)signal->repetitions - 0.5;
    (is_pulsed(signal) ? pulse : chirp)(signal->row, signal->samples,
                                        source->range + source->range_walk * part,
                                        phasor_of(1, source->turns - source->rate * part));
    for (size_t channel = 0; channel < signal->channels; channel++)
        add(signal->cube + channel * size + m * signal->samples, signal->row, signal->samples,
            source->weight[channel]);
}

/* Goes repetition by repetition, so that its samples stay in the cache. */
void signal_cube_add(const struct signal_cube *signal, const struct received_echo *received_echoes,
                     size_t count, struct arena *arena)
{
    struct source *sources = arena_get(arena, (count + 1) * sizeof *sources);
    for (size_t i = 0; i < count; i++)
        sources[i] = source_of(signal, &received_echoes[i]);
    for (size_t m = 0; m < signal->repetitions; m++)
        for (size_t i = 0; i < count; i++)
            add_source(signal, &sources[i], m);
}

/* Adds noise through the receiver's filter, closed to a ring, with its RMS unchanged. */
static void filter(struct phasor *row, const struct phasor *noise, size_t count)
{
    double tap[FILTER_REACH + 1], power = 0;
    for (size_t k = 0; k <= FILTER_REACH; k++) {
        tap[k] = point_response_value(POINT_RESPONSE_PULSE, sqrt(2) * (double)k);
        power += (k == 0 ? 1 : 2) * tap[k] * tap[k];
    }
    for (size_t k = 0; k <= 2 * (size_t)FILTER_REACH; k++) {
        size_t away = k > FILTER_REACH ? k - FILTER_REACH : FILTER_REACH - k;
        size_t shift = (k + count - FILTER_REACH) % count;
        struct phasor weight = {tap[away] / sqrt(power), 0};
        add(row, noise + shift, count - shift, weight);
        add(row + count - shift, noise, shift, weight);
    }
}

void signal_cube_add_noise(const struct signal_cube *signal, const struct random_address *address,
                           double sigma)
{
    size_t count = signal->samples, rows = signal->channels * signal->repetitions;
    double gain = point_response_noise(signal->sensor->waveform.window, signal->repetitions) *
                  (is_pulsed(signal) ? 1 : point_response_noise(signal->range_response, count));
    double elements = signal->array.elements > 0 ? (double)signal->array.elements : 1;
    double scale = sigma * sqrt(elements / 2) / gain, draw[4];
    uint32_t block = 0;
    struct phasor *noise = signal->row;
    for (size_t row = 0; row < rows; row++) {
        struct phasor *samples = signal->cube + row * count;
        for (size_t n = 0; n < count; n++) {
            if (n % 2 == 0)
                random_gaussian(address, RANDOM_SIGNAL, block++, draw);
            noise[n] = (struct phasor){scale * draw[n % 2 * 2], scale * draw[n % 2 * 2 + 1]};
        }
        if (is_pulsed(signal))
            filter(samples, noise, count);
        else
            add(samples, noise, count, (struct phasor){1, 0});
    }
}

void signal_cube_apply_windows(const struct signal_cube *signal)
{
    size_t count = signal->samples, rows = signal->channels * signal->repetitions;
    for (size_t n = 0; n < count; n++)
        signal->row[n].re =
            is_pulsed(signal) ? 1 : point_response_weight(signal->range_response, n, count);
    for (size_t row = 0; row < rows; row++) {
        struct phasor *samples = signal->cube + row * count;
        double slow = point_response_weight(signal->sensor->waveform.window,
                                            row % signal->repetitions, signal->repetitions);
        for (size_t n = 0; n < count; n++) {
            samples[n].re *= slow * signal->row[n].re;
            samples[n].im *= slow * signal->row[n].re;
        }
    }
}

void signal_cube_receive(const struct signal_cube *signal, const struct scan *scan, bool noisy)
{
    const struct effect_scan *context = &scan->context;
    struct random_address address =
        draw_address_in(context->address, false_alarm_cells_contributor(0).id);
    signal_cube_clear(signal);
    signal_cube_add(signal, scan->received.echoes, scan->received.count, context->frame->arena);
    if (noisy)
        signal_cube_add_noise(signal, &address,
                              signal->sensor->pointer_sigma *
                                  interferer_noise_factor(context->interference));
    signal_cube_apply_windows(signal);
}

/* Raises the power of one row to that of a beam, where the beam's is higher. */
static void raise_to_beam(const struct signal_cube *signal, double sine, size_t rate_bin,
                          double *power)
{
    size_t count = signal->samples, size = signal->repetitions * count;
    double part = 1 / (double)signal->channels;
    memset(signal->row, 0, count * sizeof *signal->row);
    for (size_t element = 0; element < signal->channels; element++) {
        struct phasor response = beamforming_element_response(&signal->array, sine, element);
        add(signal->row, signal->cube + element * size + rate_bin * count, count,
            (struct phasor){part * response.re, -part * response.im});
    }
    for (size_t n = 0; n < count; n++)
        power[n] = elementary_max(power[n], signal->row[n].re * signal->row[n].re +
                                                signal->row[n].im * signal->row[n].im);
}

static void raise_to_all_beams(const struct signal_cube *signal, double *power)
{
    double limit = elementary_sin(signal->sensor->field_of_view_rad / 2);
    double width = 1 / (signal->array.spacing * (double)signal->array.elements);
    size_t steps = 1 + (size_t)(2 * limit / (width / 2));
    for (size_t rate_bin = 0; rate_bin < signal->repetitions; rate_bin++)
        for (size_t i = 0; i <= steps; i++)
            raise_to_beam(signal, limit * (2 * (double)i / (double)steps - 1), rate_bin,
                          power + rate_bin * signal->samples);
}

struct range_doppler signal_cube_spectrum(const struct signal_cube *signal, struct arena *arena)
{
    size_t bins = signal->samples * signal->repetitions;
    double *power = arena_get(arena, bins * sizeof *power);
    bool array = signal->array.elements > 0;
    for (size_t i = 0; i < bins && !array; i++)
        power[i] =
            signal->cube[i].re * signal->cube[i].re + signal->cube[i].im * signal->cube[i].im;
    if (array)
        raise_to_all_beams(signal, power);
    return (struct range_doppler){
        .range_bins = signal->samples,
        .rate_bins = signal->repetitions,
        .channels = array ? signal->channels : 1,
        .range_response = signal->range_response,
        .rate_response = signal->sensor->waveform.window,
        .samples = signal->cube,
        .power = power,
    };
}
