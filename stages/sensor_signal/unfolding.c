#include "unfolding.h"

#include "base/elementary.h"
#include "radar/folding.h"

/* A beam's weights of the channels. */
struct beam {
    size_t channels;
    struct phasor weight[ARRAY_MOST_ELEMENTS];
};

static struct beam beam_at(const struct signal_cube *signal, double sine)
{
    const struct array *array = signal->array;
    if (array->count == 0)
        return (struct beam){.channels = 1, .weight = {{1, 0}}};
    struct beam beam = {.channels = array->count};
    for (size_t n = 0; n < array->count; n++) {
        struct phasor one = array_phasor(array, sine, n);
        beam.weight[n] = (struct phasor){array->weight[n] * one.re, -array->weight[n] * one.im};
    }
    return beam;
}

/* The range that a peak has with this range rate. A row of chirps is a ring of ranges. */
static double range_of(const struct signal_cube *signal, double range, double rate_mps)
{
    double bins = (double)signal->samples, least = -0.5;
    double read = range - signal->coupling * rate_mps - least;
    if (signal->chirp_s != 0)
        read -= bins * floor(read / bins);
    return (read + least) * signal->range_step_m;
}

static bool is_measured(const struct signal_cube *signal, double range_m)
{
    const struct sensor *sensor = signal->sensor;
    double half_m = sensor->cell_range_m / 2;
    return range_m >= sensor->range_min_m - half_m && range_m <= sensor->range_max_m + half_m;
}

/* The second train's sample in a beam; 0 beyond the cells that are kept. Sets the number of the
 * cell in the transform. */
static struct phasor sample_at(const struct signal_cube *signal, const struct beam *beam,
                               size_t repetition, double range, double *number)
{
    struct phasor sum = {0, 0};
    double width = (double)signal->range_cells, cell;
    *number = round(range * (double)signal->range_padding);
    cell = *number - (double)signal->first_cell;
    if (signal->range_cells == signal->row_cells)
        cell -= width * floor(cell / width);
    if (!(cell >= 0 && cell < width))
        return sum;
    const struct phasor *at = signal->second + repetition * signal->range_cells + (size_t)cell;
    for (size_t channel = 0; channel < beam->channels; channel++) {
        struct phasor value = at[channel * signal->repetitions * signal->range_cells];
        struct phasor weight = beam->weight[channel];
        sum.re += value.re * weight.re - value.im * weight.im;
        sum.im += value.re * weight.im + value.im * weight.re;
    }
    return sum;
}

/* The amplitude in the second train of an echo that was here in the middle of the first. A chirp's
 * samples count from its middle, so the phase turns by a quarter from cell to cell. */
static double focus(const struct signal_cube *signal, const struct beam *beam, double range,
                    double rate_mps)
{
    double doppler_hz = rate_mps / (signal->rate_step_mps * signal->train_s), number;
    double quarter = signal->chirp_s != 0 ? 0.25 : 0;
    struct phasor sum = {0, 0};
    for (size_t m = 0; m < signal->repetitions; m++) {
        double instant_s = signal_cube_instant_s(signal, 1, m);
        struct phasor sample = sample_at(
            signal, beam, m, range + rate_mps * instant_s / signal->range_step_m, &number);
        struct elementary_sincos turn =
            elementary_sincos_turns(doppler_hz * instant_s - quarter * number);
        sum.re += sample.re * turn.cos - sample.im * turn.sin;
        sum.im += sample.re * turn.sin + sample.im * turn.cos;
    }
    return elementary_hypot(sum.re, sum.im);
}

bool unfolding_read(const struct signal_cube *signal, const struct range_doppler_peak *peak,
                    double rate_mps, struct unfolding_reading *reading)
{
    double range_m = range_of(signal, peak->range, rate_mps);
    *reading = (struct unfolding_reading){elementary_max(range_m, 0), rate_mps};
    return is_measured(signal, range_m);
}

bool unfolding_choose(const struct signal_cube *signal, const struct range_doppler_peak *peak,
                      double amplitude, double sine, struct unfolding_reading *reading)
{
    struct beam beam = beam_at(signal, sine);
    double half_mps = (double)signal->folds * signal->fold_mps / 2, least = (double)INFINITY;
    for (size_t i = 0; i < signal->folds; i++) {
        /* 0, 1, -1, 2, -2 ... folds, then back into the bounds */
        size_t folds = (i + 1) / 2;
        double away = (double)folds * (i % 2 == 1 ? 1 : -1) * signal->fold_mps;
        double rate_mps =
            folding_range_rate_mps(peak->rate * signal->rate_step_mps + away, 0, half_mps);
        struct unfolding_reading read;
        if (!unfolding_read(signal, peak, rate_mps, &read))
            continue;
        double apart = signal->second != NULL
                           ? fabs(focus(signal, &beam, peak->range, rate_mps) - amplitude)
                           : 0;
        if (apart < least) {
            least = apart;
            *reading = read;
        }
    }
    return isfinite(least);
}
