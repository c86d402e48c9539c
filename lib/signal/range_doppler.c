#include "signal/range_doppler.h"

#include <math.h>
#include <stdbool.h>

#include "base/sort.h"

/* Noise and other echoes may raise a side lobe by this factor. */
#define SIDE_LOBE_MARGIN 2

struct peak_list {
    LIST_OF(struct range_doppler_peak) list;
};

/* True if a cell is a peak; of neighbours with equal power the first one is. */
static bool is_peak(const struct range_doppler *spectrum, size_t rate_bin, size_t range_bin)
{
    size_t width = spectrum->range_bins, height = spectrum->rate_bins;
    double power = spectrum->power[rate_bin * width + range_bin];
    for (size_t down = 0; down < 3; down++)
        for (size_t along = 0; along < 3; along++) {
            size_t row = (rate_bin + height + down - 1) % height;
            size_t column = (range_bin + width + along - 1) % width;
            double other = spectrum->power[row * width + column];
            bool before = down * 3 + along < 4;
            if (other > power || (other == power && before))
                return false;
        }
    return true;
}

static double signed_bin(size_t bin, size_t bins)
{
    return bin < bins / 2 ? (double)bin : (double)bin - (double)bins;
}

static struct range_doppler_peak peak_at(const struct range_doppler *spectrum, size_t rate_bin,
                                         size_t range_bin)
{
    size_t width = spectrum->range_bins, height = spectrum->rate_bins, stride = width * height;
    const struct phasor *row = spectrum->samples + rate_bin * width;
    const struct phasor *at = row + range_bin;
    double range =
        point_response_offset(spectrum->range_response, row + (range_bin + width - 1) % width, at,
                              row + (range_bin + 1) % width, spectrum->channels, stride);
    const struct phasor *column = spectrum->samples + range_bin;
    double rate = point_response_offset(
        spectrum->rate_response, column + (rate_bin + height - 1) % height * width, at,
        column + (rate_bin + 1) % height * width, spectrum->channels, stride);
    double gain = point_response_value(spectrum->range_response, range) *
                  point_response_value(spectrum->rate_response, rate);
    return (struct range_doppler_peak){
        .range_bin = range_bin,
        .rate_bin = rate_bin,
        .range = (double)range_bin + range,
        .rate = signed_bin(rate_bin, height) + rate,
        .gain = gain,
        .amplitude = sqrt(spectrum->power[rate_bin * width + range_bin]) / gain,
    };
}

static int compare_peaks(const void *left, const void *right)
{
    const struct range_doppler_peak *a = left, *b = right;
    if (a->amplitude != b->amplitude)
        return a->amplitude > b->amplitude ? -1 : 1;
    if (a->range_bin != b->range_bin)
        return a->range_bin < b->range_bin ? -1 : 1;
    return (a->rate_bin > b->rate_bin) - (a->rate_bin < b->rate_bin);
}

double range_doppler_distance(double to, double from, size_t bins)
{
    return remainder(to - from, (double)bins);
}

static bool is_side_lobe(const struct range_doppler *spectrum,
                         const struct range_doppler_peak *peak,
                         const struct range_doppler_peak *stronger)
{
    double range = range_doppler_distance(peak->range, stronger->range, spectrum->range_bins);
    double rate = range_doppler_distance(peak->rate, stronger->rate, spectrum->rate_bins);
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
                           double threshold, struct arena *arena, struct range_doppler_peak **peaks)
{
    size_t width = spectrum->range_bins;
    struct peak_list found = {{NULL, 0, 0}};
    /* But for noise, no bin is farther from its peak than half a bin on both axes. */
    double loss = point_response_value(spectrum->range_response, 0.5) *
                  point_response_value(spectrum->rate_response, 0.5) / SIDE_LOBE_MARGIN;
    double least = threshold * threshold * loss * loss;
    for (size_t row = 0; row < spectrum->rate_bins; row++) {
        const double *power = spectrum->power + row * width;
        for (size_t column = 0; column < width; column++) {
            if (!(power[column] >= least) || !is_peak(spectrum, row, column) ||
                power[column] <
                    cfar_threshold(cfar, spectrum->power + column, spectrum->rate_bins, width, row))
                continue;
            struct range_doppler_peak peak = peak_at(spectrum, row, column);
            if (peak.amplitude >= threshold)
                *list_add(&found.list, arena) = peak;
        }
    }
    sort_items(found.list.items, found.list.count, sizeof *found.list.items, compare_peaks, arena);
    *peaks = found.list.items;
    return drop_side_lobes(spectrum, found.list.items, found.list.count);
}

double range_doppler_amplitude(const struct range_doppler *spectrum, double range, double rate)
{
    size_t width = spectrum->range_bins, height = spectrum->rate_bins;
    double column = round(range), row = round(rate);
    column -= (double)width * floor(column / (double)width);
    row -= (double)height * floor(row / (double)height);
    return sqrt(spectrum->power[(size_t)row * width + (size_t)column]);
}
