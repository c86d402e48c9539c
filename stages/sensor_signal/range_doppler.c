#include "range_doppler.h"

#include "base/elementary.h"
#include "base/sort.h"

/* Noise and other echoes may raise a side lobe by this factor. */
#define SIDE_LOBE_MARGIN 2

/* True if a cell is a peak; of neighbours with equal power the first one is. */
static bool is_peak(const struct range_doppler *spectrum, size_t rate_cell, size_t range_cell)
{
    size_t width = spectrum->range_cells, height = spectrum->rate_cells;
    double power = spectrum->strongest[rate_cell * width + range_cell];
    for (size_t down = 0; down < 3; down++)
        for (size_t along = 0; along < 3; along++) {
            size_t row = (rate_cell + height + down - 1) % height;
            size_t column = (range_cell + width + along - 1) % width;
            double other = spectrum->strongest[row * width + column];
            bool before = down * 3 + along < 4;
            if (other > power || (other == power && before))
                return false;
        }
    return true;
}

/* The strongest beam of a cell; of equal ones the first. */
static size_t strongest_beam(const struct range_doppler *spectrum, size_t cell)
{
    size_t beam = 0, size = spectrum->range_cells * spectrum->rate_cells;
    while (beam + 1 < spectrum->beams &&
           spectrum->power[beam * size + cell] < spectrum->strongest[cell])
        beam++;
    return beam;
}

static double signed_cell(size_t cell, size_t cells)
{
    return cell < cells / 2 ? (double)cell : (double)cell - (double)cells;
}

static struct range_doppler_peak peak_in_beam(const struct range_doppler *spectrum,
                                              const struct cfar *cfar, size_t row, size_t column,
                                              size_t beam)
{
    size_t width = spectrum->range_cells, height = spectrum->rate_cells;
    const double *power = spectrum->power + beam * width * height + column;
    return (struct range_doppler_peak){
        .range_cell = column,
        .rate_cell = row,
        .beam = beam,
        .range = (spectrum->first_cell + (double)column) / (double)spectrum->range_padding,
        .rate = signed_cell(row, height) / (double)spectrum->rate_padding,
        .gain = 1,
        .amplitude = sqrt(power[row * width]),
        .threshold = sqrt(cfar_threshold(cfar, power, height, width, row)),
    };
}

static bool is_above_threshold(const struct range_doppler_peak *peak)
{
    return peak->amplitude >= peak->threshold;
}

/* The peak of a cell in its strongest beam; if that is below its threshold, in the strongest beam
 * that is above: noise differs between beams, and each has its share of the false alarms. */
static struct range_doppler_peak peak_at(const struct range_doppler *spectrum,
                                         const struct cfar *cfar, size_t row, size_t column)
{
    size_t strongest = strongest_beam(spectrum, row * spectrum->range_cells + column);
    struct range_doppler_peak peak = peak_in_beam(spectrum, cfar, row, column, strongest);
    if (is_above_threshold(&peak))
        return peak;
    for (size_t beam = 0; beam < spectrum->beams; beam++) {
        struct range_doppler_peak other = peak_in_beam(spectrum, cfar, row, column, beam);
        if (is_above_threshold(&other) &&
            (!is_above_threshold(&peak) || other.amplitude > peak.amplitude))
            peak = other;
    }
    return peak;
}

/* Moves a peak from its cell to its place between the cells. */
static void interpolate(const struct range_doppler *spectrum, struct range_doppler_peak *peak)
{
    size_t width = spectrum->range_cells, height = spectrum->rate_cells;
    const double *power = spectrum->power + peak->beam * width * height;
    const double *row = power + peak->rate_cell * width, *column = power + peak->range_cell;
    size_t along = peak->range_cell, down = peak->rate_cell;
    double range = point_response_vertex(row[(along + width - 1) % width], row[along],
                                         row[(along + 1) % width]) /
                   (double)spectrum->range_padding;
    double rate = point_response_vertex(column[(down + height - 1) % height * width],
                                        column[down * width], column[(down + 1) % height * width]) /
                  (double)spectrum->rate_padding;
    peak->gain = point_response_value(spectrum->range_response, range) *
                 point_response_value(spectrum->rate_response, rate);
    peak->range += range;
    peak->rate += rate;
    peak->amplitude /= peak->gain;
    peak->threshold /= peak->gain;
}

static int compare_peaks(const void *left, const void *right)
{
    const struct range_doppler_peak *a = left, *b = right;
    if (a->amplitude != b->amplitude)
        return a->amplitude > b->amplitude ? -1 : 1;
    if (a->range_cell != b->range_cell)
        return a->range_cell < b->range_cell ? -1 : 1;
    return (a->rate_cell > b->rate_cell) - (a->rate_cell < b->rate_cell);
}

double range_doppler_distance(double to, double from, size_t bins)
{
    return remainder(to - from, (double)bins);
}

void range_doppler_away(const struct range_doppler *spectrum, const struct range_doppler_peak *peak,
                        double *range, double *rate)
{
    size_t rate_bins = spectrum->rate_cells / spectrum->rate_padding;
    *range = range_doppler_distance(*range, peak->range, spectrum->range_bins);
    *rate = range_doppler_distance(*rate, peak->rate, rate_bins);
}

static bool is_side_lobe(const struct range_doppler *spectrum,
                         const struct range_doppler_peak *peak,
                         const struct range_doppler_peak *stronger)
{
    double range = peak->range, rate = peak->rate;
    range_doppler_away(spectrum, stronger, &range, &rate);
    if (fabs(range) < point_response_main_lobe(spectrum->range_response) &&
        fabs(rate) < point_response_main_lobe(spectrum->rate_response))
        return false;
    double most = stronger->amplitude * point_response_envelope(spectrum->range_response, range) *
                  point_response_envelope(spectrum->rate_response, rate);
    return peak->amplitude < SIDE_LOBE_MARGIN * most;
}

static size_t drop_side_lobes(const struct range_doppler *spectrum,
                              struct range_doppler_peak *peaks, size_t count)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        bool covered = false;
        for (size_t j = 0; j < kept && !covered; j++)
            covered = is_side_lobe(spectrum, &peaks[i], &peaks[j]);
        if (!covered)
            peaks[kept++] = peaks[i];
    }
    return kept;
}

size_t range_doppler_peaks(const struct range_doppler *spectrum, const struct cfar *cfar,
                           double least, struct arena *arena, struct range_doppler_peak **peaks)
{
    size_t edge = spectrum->range_ring ? 0 : 1;
    LIST_OF(struct range_doppler_peak) found = {0};
    for (size_t row = 0; row < spectrum->rate_cells; row++)
        for (size_t column = edge; column + edge < spectrum->range_cells; column++) {
            if (!is_peak(spectrum, row, column))
                continue;
            struct range_doppler_peak peak = peak_at(spectrum, cfar, row, column);
            if (!is_above_threshold(&peak))
                continue;
            interpolate(spectrum, &peak);
            if (peak.amplitude >= least)
                *list_add(&found, arena) = peak;
        }
    sort_list(&found, compare_peaks, arena);
    *peaks = found.items;
    return drop_side_lobes(spectrum, found.items, found.count);
}

struct range_doppler_peak range_doppler_at(const struct range_doppler *spectrum,
                                           const struct cfar *cfar, double range, double rate)
{
    size_t width = spectrum->range_cells, height = spectrum->rate_cells;
    double column = round(range * (double)spectrum->range_padding) - spectrum->first_cell;
    double row = round(rate * (double)spectrum->rate_padding);
    if (spectrum->range_ring)
        column -= (double)width * floor(column / (double)width);
    column = elementary_min(elementary_max(column, 0), (double)(width - 1));
    row -= (double)height * floor(row / (double)height);
    return peak_at(spectrum, cfar, (size_t)row, (size_t)column);
}
