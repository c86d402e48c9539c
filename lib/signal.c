#include "signal.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#include "elementary.h"
#include "units.h"

/* Beyond so many bins a pulse is below 2^-36 of itself. */
#define PULSE_REACH 12
/* Of the receiver's filter for pulses, whose own correlation is their kernel: 2^-(k^2/2). */
#define FILTER_REACH 7

static bool pulsed(const struct signal *signal)
{
    return signal->sensor->waveform.kind == WAVEFORM_PULSE;
}

struct signal signal_of(const struct sensor *sensor)
{
    const struct waveform *waveform = &sensor->waveform;
    return (struct signal){
        .sensor = sensor,
        .samples = (size_t)waveform->samples,
        .repetitions = (size_t)waveform->repetitions,
        .channels = waveform->elements > 0 ? (size_t)waveform->elements : 2,
        .range_step_m = waveform_range_step_m(waveform, sensor->cell_range_m),
        .rate_step_mps = sensor->cell_range_rate_mps,
        .array = {(size_t)waveform->elements, waveform->spacing},
    };
}

size_t signal_size(const struct signal *signal)
{
    return signal->channels * signal->repetitions * signal->samples;
}

void signal_clear(const struct signal *signal)
{
    memset(signal->cube, 0, signal_size(signal) * sizeof *signal->cube);
}

static struct phasor turn(double amplitude, double turns)
{
    struct elementary_sincos phase = elementary_sincos_turns(turns);
    return (struct phasor){amplitude * phase.cos, amplitude * phase.sin};
}

static struct phasor times(struct phasor a, struct phasor b)
{
    return (struct phasor){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

static struct phasor channel_weight(const struct signal *signal, const struct ray *ray,
                                    size_t channel)
{
    struct antenna_pointers pointers =
        antenna_pointers(&signal->sensor->antenna, ray->echo.azimuth_rad);
    double sine = elementary_sin(ray->echo.azimuth_rad);
    if (signal->array.elements > 0) {
        struct phasor response = beam_response(&signal->array, sine, channel);
        return (struct phasor){ray->amplitude * response.re, ray->amplitude * response.im};
    }
    double _Complex pointer = channel == 0 ? pointers.sum : pointers.delta;
    return (struct phasor){ray->strength * creal(pointer), ray->strength * cimag(pointer)};
}

/* The samples of one repetition: a tone by rotation, which n steps leave within n ulp. */
static void chirp(struct phasor *tone, size_t count, double cells, struct phasor first)
{
    struct phasor step = turn(1, -cells / (double)count);
    tone[0] = times(first, turn(1, cells / 2));
    for (size_t n = 1; n < count; n++)
        tone[n] = times(tone[n - 1], step);
}

static void pulse(struct phasor *tone, size_t count, double bins, struct phasor first)
{
    double begin = fmax(ceil(bins - PULSE_REACH), 0), end = floor(bins + PULSE_REACH);
    memset(tone, 0, count * sizeof *tone);
    for (double n = begin; n <= end && n < (double)count; n++) {
        double size = kernel_value(KERNEL_PULSE, n - bins);
        tone[(size_t)n] = (struct phasor){size * first.re, size * first.im};
    }
}

static void add(struct phasor *row, const struct phasor *tone, size_t count, struct phasor weight)
{
    for (size_t n = 0; n < count; n++) {
        row[n].re += tone[n].re * weight.re - tone[n].im * weight.im;
        row[n].im += tone[n].re * weight.im + tone[n].im * weight.re;
    }
}

void signal_add(const struct signal *signal, const struct ray *ray)
{
    size_t size = signal->repetitions * signal->samples;
    struct phasor weight[BEAM_MOST_ELEMENTS];
    for (size_t channel = 0; channel < signal->channels; channel++)
        weight[channel] = channel_weight(signal, ray, channel);
    double walk_m = ray->range_rate_mps * units_wavelength_m(signal->sensor->carrier_hz) /
                    (2 * signal->rate_step_mps);
    for (size_t m = 0; m < signal->repetitions; m++) {
        double part = (double)m / (double)signal->repetitions - 0.5;
        struct phasor first =
            turn(1, ray->phase_rad / (2 * PI) - ray->range_rate_mps / signal->rate_step_mps * part);
        double bins = (ray->range_m + walk_m * part) / signal->range_step_m;
        (pulsed(signal) ? pulse : chirp)(signal->row, signal->samples, bins, first);
        for (size_t channel = 0; channel < signal->channels; channel++)
            add(signal->cube + channel * size + m * signal->samples, signal->row, signal->samples,
                weight[channel]);
    }
}

/* Through the receiver's filter, round the row, with the RMS that it had. */
static void filter(struct phasor *row, const struct phasor *noise, size_t count)
{
    double tap[FILTER_REACH + 1], power = 0;
    for (size_t k = 0; k <= FILTER_REACH; k++) {
        tap[k] = kernel_value(KERNEL_PULSE, sqrt(2) * (double)k);
        power += (k == 0 ? 1 : 2) * tap[k] * tap[k];
    }
    for (size_t n = 0; n < count; n++)
        for (size_t k = 0; k <= 2 * (size_t)FILTER_REACH; k++) {
            size_t away = k > FILTER_REACH ? k - FILTER_REACH : FILTER_REACH - k;
            const struct phasor *from = &noise[(n + k + count - FILTER_REACH) % count];
            row[n].re += tap[away] / sqrt(power) * from->re;
            row[n].im += tap[away] / sqrt(power) * from->im;
        }
}

void signal_add_noise(const struct signal *signal, const struct random_address *address,
                      double sigma)
{
    size_t count = signal->samples, rows = signal->channels * signal->repetitions;
    struct spectrum after = signal_spectrum(signal);
    double through = kernel_noise(after.rate_kernel, signal->repetitions) *
                     (pulsed(signal) ? 1 : kernel_noise(after.range_kernel, count));
    double elements = signal->array.elements > 0 ? (double)signal->array.elements : 1;
    double scale = sigma * sqrt(elements / 2) / through, draw[4];
    uint32_t block = 0;
    struct phasor *noise = signal->row;
    for (size_t row = 0; row < rows; row++) {
        struct phasor *samples = signal->cube + row * count;
        for (size_t n = 0; n < count; n++) {
            if (n % 2 == 0)
                random_gaussian(address, RANDOM_SIGNAL, block++, draw);
            noise[n] = (struct phasor){scale * draw[n % 2 * 2], scale * draw[n % 2 * 2 + 1]};
        }
        if (pulsed(signal))
            filter(samples, noise, count);
        else
            add(samples, noise, count, (struct phasor){1, 0});
    }
}

void signal_weigh(const struct signal *signal)
{
    size_t count = signal->samples, rows = signal->channels * signal->repetitions;
    struct spectrum after = signal_spectrum(signal);
    for (size_t n = 0; n < count; n++)
        signal->row[n].re = pulsed(signal) ? 1 : kernel_weight(after.range_kernel, n, count);
    for (size_t row = 0; row < rows; row++) {
        struct phasor *samples = signal->cube + row * count;
        double slow =
            kernel_weight(after.rate_kernel, row % signal->repetitions, signal->repetitions);
        for (size_t n = 0; n < count; n++) {
            samples[n].re *= slow * signal->row[n].re;
            samples[n].im *= slow * signal->row[n].re;
        }
    }
}

struct spectrum signal_spectrum(const struct signal *signal)
{
    enum kernel window = signal->sensor->waveform.window;
    return (struct spectrum){
        .range_bins = signal->samples,
        .rate_bins = signal->repetitions,
        .channels = signal->channels,
        .detecting = signal->array.elements > 0 ? signal->channels : 1,
        .range_kernel = pulsed(signal) ? KERNEL_PULSE : window,
        .rate_kernel = window,
        .samples = signal->cube,
    };
}
