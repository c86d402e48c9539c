#include "signal_cube.h"

#include <complex.h>

#include "base/elementary.h"
#include "base/units.h"
#include "noise/false_alarm_cells.h"
#include "radar/interferer.h"
#include "sensor/scan.h"

/* A pulse is below 2^-36 of its peak beyond this many bins. */
#define PULSE_REACH 12
/* Reach in bins of the receiver's filter for pulses, 2^-(k^2/2); its autocorrelation is the point
 * response of pulses. */
#define FILTER_REACH 7
/* Bins of range that are kept beyond the sensor's ranges. */
#define MARGIN 4

static bool is_pulsed(const struct signal_cube *signal)
{
    return signal->range_response == POINT_RESPONSE_PULSE;
}

/* Times of the waveform, and how a chirp couples range with range rate. */
static void set_times(struct signal_cube *signal)
{
    const struct sensor *sensor = signal->sensor;
    double bandwidth_hz = SPEED_OF_LIGHT_MPS / (2 * sensor->cell_range_m);
    signal->train_s = units_wavelength_m(sensor->carrier_hz) / (2 * signal->rate_step_mps);
    signal->repetition_s = signal->train_s / (double)signal->repetitions;
    signal->fold_mps = (double)signal->repetitions * signal->rate_step_mps;
    if (is_pulsed(signal))
        return;
    signal->slope_hzps = sensor->chirp_slope_hzps != 0
                             ? sensor->chirp_slope_hzps
                             : bandwidth_hz / signal->repetition_s * (double)signal->turns;
    signal->chirp_s = bandwidth_hz / signal->slope_hzps;
    signal->coupling = sensor->carrier_hz / signal->slope_hzps / signal->range_step_m;
}

/* Keeps the cells from the least to the greatest measured range, or the whole row. */
static void set_cells(struct signal_cube *signal)
{
    signal->range_padding = is_pulsed(signal) ? 1 : SIGNAL_CUBE_PADDING;
    signal->row_cells = signal->range_padding * signal->samples;
    double farthest = signal->sensor->range_max_m / signal->range_step_m;
    double shift = fabs(signal->coupling) * (double)signal->folds * signal->fold_mps / 2 + MARGIN;
    double below = ceil(shift * SIGNAL_CUBE_PADDING);
    double cells = below + ceil((farthest + shift) * SIGNAL_CUBE_PADDING) + 1;
    bool all = is_pulsed(signal) || cells >= (double)signal->row_cells;
    signal->first_cell = all ? 0 : -(ptrdiff_t)below;
    signal->range_cells = all ? signal->row_cells : (size_t)cells;
}

static void set_memory(struct signal_cube *signal, struct arena *arena)
{
    size_t channels = signal->channels, kept = signal->range_cells;
    size_t rows = channels * signal->repetitions;
    signal->weight = arena_get(arena, signal->samples * sizeof *signal->weight);
    signal->tone = arena_get(arena, signal->samples * sizeof *signal->tone);
    signal->rows = arena_get(arena, channels * signal->row_cells * sizeof *signal->rows);
    signal->spectrum =
        arena_get(arena, SIGNAL_CUBE_PADDING * rows * kept * sizeof *signal->spectrum);
    if (signal->sensor->waveform.stagger > 0)
        signal->second = arena_get(arena, rows * kept * sizeof *signal->second);
    for (size_t n = 0; n < signal->samples; n++)
        signal->weight[n] = is_pulsed(signal)
                                ? 1
                                : point_response_weight(signal->range_response, n, signal->samples);
}

struct signal_cube signal_cube_of(const struct sensor *sensor, struct arena *arena)
{
    const struct waveform *waveform = &sensor->waveform;
    struct signal_cube signal = {
        .sensor = sensor,
        .samples = (size_t)waveform->samples,
        .repetitions = (size_t)waveform->repetitions,
        .channels = 2,
        .range_response = waveform_range_response(waveform),
        .range_step_m = waveform_range_step_m(waveform, sensor->cell_range_m),
        .rate_step_mps = sensor->cell_range_rate_mps,
        .array = &sensor->beams,
        .turns = 1,
    };
    if (signal.array->count > 0) {
        signal.channels = signal.array->count;
        signal.turns = sensor->array.transmit.count;
    }
    signal.folds = waveform->stagger > 0 ? (size_t)waveform->stagger : signal.turns;
    set_times(&signal);
    set_cells(&signal);
    set_memory(&signal, arena);
    return signal;
}

double signal_cube_turn_phase(const struct signal_cube *signal, size_t channel, double rate_mps)
{
    double later_s =
        signal->repetition_s * (double)signal->array->turn[channel] / (double)signal->turns;
    return -2 * rate_mps * later_s / units_wavelength_m(signal->sensor->carrier_hz);
}

double signal_cube_instant_s(const struct signal_cube *signal, size_t train, size_t repetition)
{
    double number = (double)repetition, half_s = signal->train_s / 2;
    if (train == 0)
        return signal->repetition_s * number - half_s;
    return half_s + signal->repetition_s * (1 + 1 / (double)signal->folds) * number;
}

void signal_cube_place(const struct signal_cube *signal, const struct received_echo *received,
                       double *range, double *rate)
{
    double rate_mps = received->echo.range_rate_mps;
    *range = received->range_m / signal->range_step_m + signal->coupling * rate_mps;
    *rate = rate_mps / signal->rate_step_mps;
}

static struct phasor phasor_of(double turns)
{
    struct elementary_sincos phase = elementary_sincos_turns(turns);
    return (struct phasor){phase.cos, phase.sin};
}

static struct phasor times(struct phasor a, struct phasor b)
{
    return (struct phasor){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

/* An echo as the channels receive it: its delay at the instant of the measurement, and by how much
 * that grows in a second. */
struct signal_source {
    struct phasor weight[ARRAY_MOST_ELEMENTS];
    double turns, delay_s, stretch;
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
    for (size_t n = 0; n < signal->array->count; n++) {
        struct phasor one = array_phasor(signal->array, sine, n);
        weight[n] = (struct phasor){received->amplitude * one.re, received->amplitude * one.im};
    }
}

/* Growth of the delay in the range cells since the instant of the measurement. A radar that
 * compensates range migration shifts the cells back, but not the carrier's phase (MODEL 14.20). */
static double walked_s(const struct signal_cube *signal, const struct signal_source *source,
                       double instant_s)
{
    bool compensated = signal->sensor->range_migration == MIGRATION_COMPENSATED;
    return compensated ? 0 : source->stretch * instant_s;
}

/* A polynomial of the phase, in turns, over the time since the middle of a chirp in units of its
 * length. */
struct chirp_phase {
    double constant, linear, square;
};

/* The phase of MODEL 11.3 in powers of t'. The turns of the carrier over the range are not in it:
 * they are part of the echo's phase. */
static struct chirp_phase chirp_phase_of(const struct signal_cube *signal,
                                         const struct signal_source *source, double instant_s)
{
    double carrier_hz = signal->sensor->carrier_hz, slope = signal->slope_hzps;
    double stretch = source->stretch, length = signal->chirp_s;
    double moved_s = stretch * instant_s;
    double delay_s = source->delay_s + walked_s(signal, source, instant_s);
    return (struct chirp_phase){
        .constant =
            source->turns - moved_s * (carrier_hz - slope * (source->delay_s + moved_s / 2)),
        .linear = -length * (carrier_hz * stretch + slope * delay_s * (1 - stretch)),
        .square = -length * length * slope * stretch * (1 - stretch / 2),
    };
}

/* The samples of one chirp by rotation from sample to sample, in CHAINS independent chains for
 * speed. The rotation itself turns with the square of time. The error of n samples is at most
 * n/CHAINS ulp. */
static void chirp(struct phasor *tone, size_t count, struct chirp_phase phase)
{
    enum { CHAINS = 4 };
    double unit = 1 / (double)count, leap = CHAINS * unit;
    struct phasor step[CHAINS], turn = phasor_of(2 * phase.square * leap * leap);
    for (size_t n = 0; n < CHAINS; n++) {
        double x = (double)n * unit - 0.5;
        tone[n] = phasor_of(phase.constant + x * (phase.linear + x * phase.square));
        step[n] = phasor_of(leap * (phase.linear + phase.square * (2 * x + leap)));
    }
    for (size_t n = CHAINS; n < count; n++) {
        tone[n] = times(tone[n - CHAINS], step[n % CHAINS]);
        step[n % CHAINS] = times(step[n % CHAINS], turn);
    }
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

/* Both parts of a complex number at once, as most time is spent here; each rounds as if alone. */
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

/* Adds a source to the channels of the transmitter whose turn it is. */
static void add_source(const struct signal_cube *signal, const struct signal_source *source,
                       double instant_s, size_t turn)
{
    instant_s += signal->repetition_s * (double)turn / (double)signal->turns;
    if (is_pulsed(signal)) {
        double moved_s = source->stretch * instant_s;
        double delay_s = source->delay_s + walked_s(signal, source, instant_s);
        double range_m = delay_s * SPEED_OF_LIGHT_MPS / 2;
        pulse(signal->tone, signal->samples, range_m / signal->range_step_m,
              phasor_of(source->turns - signal->sensor->carrier_hz * moved_s));
    } else {
        chirp(signal->tone, signal->samples, chirp_phase_of(signal, source, instant_s));
    }
    for (size_t channel = 0; channel < signal->channels; channel++)
        if (signal->array->turn[channel] == turn)
            add(signal->rows + channel * signal->row_cells, signal->tone, signal->samples,
                source->weight[channel]);
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

/* The deviation of each part of a sample's noise that gives a cell, in a beam of an array, the RMS
 * sigma. */
static double sample_sigma(const struct signal_cube *signal, double sigma)
{
    double gain =
        point_response_noise(signal->sensor->waveform.window, signal->repetitions) *
        (is_pulsed(signal) ? 1 : point_response_noise(signal->range_response, signal->samples));
    double beam = signal->array->count > 0 ? signal->array->noise : 1;
    return sigma * sqrt(0.5) / beam / gain;
}

static void add_noise(const struct signal_cube *signal, const struct signal_input *input,
                      size_t number)
{
    size_t count = signal->samples;
    double scale = sample_sigma(signal, input->sigma), draw[4];
    struct phasor *noise = signal->tone;
    uint32_t block = (uint32_t)(number * signal->channels * ((count + 1) / 2));
    for (size_t channel = 0; channel < signal->channels; channel++) {
        struct phasor *row = signal->rows + channel * signal->row_cells;
        for (size_t n = 0; n < count; n++) {
            if (n % 2 == 0)
                random_gaussian(&input->address, RANDOM_SIGNAL, block++, draw);
            noise[n] = (struct phasor){scale * draw[n % 2 * 2], scale * draw[n % 2 * 2 + 1]};
        }
        if (is_pulsed(signal))
            filter(row, noise, count);
        else
            add(row, noise, count, (struct phasor){1, 0});
    }
}

struct signal_input signal_cube_sources(const struct signal_cube *signal,
                                        const struct received_echo *received_echoes, size_t count,
                                        struct arena *arena)
{
    struct signal_source *sources = arena_get(arena, (count + 1) * sizeof *sources);
    for (size_t i = 0; i < count; i++) {
        const struct received_echo *received = &received_echoes[i];
        sources[i].turns = received->phase_rad / (2 * PI);
        sources[i].delay_s = 2 * received->range_m / SPEED_OF_LIGHT_MPS;
        sources[i].stretch = 2 * received->echo.range_rate_mps / SPEED_OF_LIGHT_MPS;
        weigh_channels(signal, received, sources[i].weight);
    }
    return (struct signal_input){.sources = sources, .count = count};
}

struct signal_input signal_cube_input(const struct signal_cube *signal, const struct scan *scan,
                                      bool noisy)
{
    const struct effect_scan *context = &scan->context;
    struct signal_input input = signal_cube_sources(signal, scan->received.echoes,
                                                    scan->received.count, context->frame->arena);
    input.address = frame_draw_address_in(context->address, false_alarm_cells_contributor(0).id);
    if (noisy)
        input.sigma =
            signal->sensor->pointer_sigma * interferer_noise_factor(context->interference);
    return input;
}

void signal_cube_receive(const struct signal_cube *signal, const struct signal_input *input,
                         size_t train, size_t repetition)
{
    double instant_s = signal_cube_instant_s(signal, train, repetition);
    double slow =
        point_response_weight(signal->sensor->waveform.window, repetition, signal->repetitions);
    memset(signal->rows, 0, signal->channels * signal->row_cells * sizeof *signal->rows);
    for (size_t i = 0; i < input->count; i++)
        for (size_t turn = 0; turn < signal->turns; turn++)
            add_source(signal, &input->sources[i], instant_s, turn);
    if (input->sigma > 0)
        add_noise(signal, input, train * signal->repetitions + repetition);
    for (size_t channel = 0; channel < signal->channels; channel++)
        for (size_t n = 0; n < signal->samples; n++) {
            struct phasor *sample = &signal->rows[channel * signal->row_cells + n];
            sample->re *= slow * signal->weight[n];
            sample->im *= slow * signal->weight[n];
        }
}

void signal_cube_store(const struct signal_cube *signal, size_t train, size_t repetition)
{
    size_t kept = signal->range_cells, size = kept * sizeof *signal->rows;
    size_t rows = (train == 0 ? SIGNAL_CUBE_PADDING : 1) * signal->repetitions;
    size_t negative = (size_t)-signal->first_cell;
    for (size_t channel = 0; channel < signal->channels; channel++) {
        const struct phasor *from = signal->rows + channel * signal->row_cells;
        struct phasor *base =
            (train == 0 ? signal->spectrum : signal->second) + channel * rows * kept;
        struct phasor *to = base + repetition * kept;
        memcpy(to, from + signal->row_cells - negative, negative * sizeof *to);
        memcpy(to + negative, from, size - negative * sizeof *to);
        if (train == 0)
            memset(to + signal->repetitions * kept, 0, size);
    }
}

/* The power of one row of the spectrum in a beam, for the range rate that is so many folds away. */
static void form_beam(const struct signal_cube *signal, double sine, size_t rate_cell, size_t fold,
                      double *power)
{
    double rate_mps = (double)rate_cell / SIGNAL_CUBE_PADDING * signal->rate_step_mps +
                      (double)fold * signal->fold_mps;
    size_t kept = signal->range_cells, size = SIGNAL_CUBE_PADDING * signal->repetitions * kept;
    struct phasor *sum = signal->rows;
    memset(sum, 0, kept * sizeof *sum);
    for (size_t n = 0; n < signal->channels; n++) {
        double weight = signal->array->weight[n];
        struct phasor turn = phasor_of(signal_cube_turn_phase(signal, n, rate_mps));
        struct phasor one = times(array_phasor(signal->array, sine, n), turn);
        add(sum, signal->spectrum + n * size + rate_cell * kept, kept,
            (struct phasor){weight * one.re, -weight * one.im});
    }
    for (size_t n = 0; n < kept; n++)
        power[n] = sum[n].re * sum[n].re + sum[n].im * sum[n].im;
}

/* Forms all beams from edge to edge of the field of view, and finds the strongest in each cell. */
static void form_beams(const struct signal_cube *signal, const struct range_doppler *spectrum,
                       double *power, double *strongest)
{
    double limit = elementary_sin(signal->sensor->field_of_view_rad / 2);
    size_t kept = spectrum->range_cells, size = kept * spectrum->rate_cells;
    for (size_t row = 0; row < spectrum->rate_cells; row++)
        for (size_t beam = 0; beam < spectrum->beams; beam++) {
            size_t directions = spectrum->beams / signal->turns;
            double part = (double)(beam % directions) / (double)(directions - 1);
            double *at = power + beam * size + row * kept;
            form_beam(signal, limit * (2 * part - 1), row, beam / directions, at);
            for (size_t n = 0; n < kept; n++)
                strongest[row * kept + n] = elementary_max(strongest[row * kept + n], at[n]);
        }
}

static size_t beams_of(const struct signal_cube *signal)
{
    if (signal->array->count == 0)
        return 1;
    double limit = elementary_sin(signal->sensor->field_of_view_rad / 2);
    double width = 1 / (signal->array->spacing * (double)signal->array->count);
    return signal->turns * (2 + (size_t)(2 * limit / (width / 2)));
}

/* The power of each sample, |s|^2. */
static void take_power(const struct phasor *samples, size_t count, double *power)
{
    for (size_t i = 0; i < count; i++)
        power[i] = samples[i].re * samples[i].re + samples[i].im * samples[i].im;
}

struct range_doppler signal_cube_spectrum(const struct signal_cube *signal, struct arena *arena)
{
    size_t rate_cells = SIGNAL_CUBE_PADDING * signal->repetitions;
    size_t cells = signal->range_cells * rate_cells, beams = beams_of(signal);
    double *power = arena_get(arena, (beams + 1) * cells * sizeof *power);
    struct range_doppler spectrum = {
        .range_cells = signal->range_cells,
        .rate_cells = rate_cells,
        .beams = beams,
        .range_ring = signal->range_cells == signal->row_cells,
        .range_padding = signal->range_padding,
        .rate_padding = SIGNAL_CUBE_PADDING,
        .first_cell = (double)signal->first_cell,
        .range_bins = signal->samples,
        .range_response = signal->range_response,
        .rate_response = signal->sensor->waveform.window,
        .power = power,
        .strongest = beams > 1 ? power + beams * cells : power,
    };
    if (beams > 1)
        form_beams(signal, &spectrum, power, power + beams * cells);
    else
        take_power(signal->spectrum, cells, power);
    return spectrum;
}
