/* Peaks of a range-Doppler spectrum: their places and amplitudes (MODEL 11.3).
 *
 * A peak is a cell that none of its eight neighbours exceeds in power, with both axes closed to
 * rings. It must exceed the CFAR threshold (cfar.h) among the range rates of its range; along
 * range, walls and rows of posts would hide themselves. Its place is interpolated between the bins,
 * and its amplitude is that at this place (point_response.h), which must meet the threshold.
 * Stronger peaks take precedence: a peak that is less than twice what the side lobes of a stronger
 * one can be at its place is taken for one of them. */
#ifndef RANGE_DOPPLER_H
#define RANGE_DOPPLER_H

#include "base/arena.h"
#include "radar/cfar.h"
#include "radar/point_response.h"

struct range_doppler {
    size_t range_bins, rate_bins;
    size_t channels; /* channels by which places are interpolated */
    enum point_response range_response, rate_response;
    const struct phasor *samples; /* [channel][rate bin][range bin] */
    const double *power;          /* [rate bin][range bin]: the power in which peaks are searched */
};

struct range_doppler_peak {
    size_t range_bin, rate_bin;
    double range, rate; /* in bins; rate from -rate_bins / 2 on */
    double gain;        /* response at the bin relative to that at the peak */
    double amplitude;
};

/* Finds the peaks, strongest first, and returns their number; memory comes from the arena. */
size_t range_doppler_peaks(const struct range_doppler *spectrum, const struct cfar *cfar,
                           double threshold, struct arena *arena,
                           struct range_doppler_peak **peaks);

/* The distance, with its sign, from one place on a ring of bins to another, in [-bins / 2, bins /
 * 2]. */
double range_doppler_distance(double to, double from, size_t bins);

/* The root of the power in the bin nearest to a place. */
double range_doppler_amplitude(const struct range_doppler *spectrum, double range, double rate);

#endif
