/* Peaks in a range-Doppler spectrum: where echoes stand in it, and how strong they are (EFFECTS
 * 11).
 *
 * A peak is a cell that no neighbour exceeds in power, all eight of them, with both axes closed to
 * rings. It must stand out as cfar.h says among the rates of its range: along
 * range, walls and rows of posts would hide themselves. Its place is read between the bins and its
 * amplitude there (point_response.h); that must meet the threshold. Stronger peaks are believed
 * first: one that is less than twice of what a stronger one's side lobes can be where it stands, is
 * one of those. */
#ifndef RANGE_DOPPLER_H
#define RANGE_DOPPLER_H

#include "base/arena.h"
#include "radar/cfar.h"
#include "radar/point_response.h"

struct range_doppler {
    size_t range_bins, rate_bins;
    size_t channels; /* so many read places between the bins */
    enum point_response range_kernel, rate_kernel;
    const struct phasor *samples; /* [channel][rate bin][range bin] */
    const double *power;          /* [rate bin][range bin]: what is seen */
};

struct range_doppler_peak {
    size_t range_bin, rate_bin;
    double range, rate; /* in bins; rate from -rate_bins / 2 */
    double gain;        /* of the bin, where the peak has 1 */
    double amplitude;
};

/* Writes the peaks, strongest first; memory comes from the arena. */
size_t range_doppler_peaks(const struct range_doppler *spectrum, const struct cfar *cfar,
                           double threshold, struct arena *arena,
                           struct range_doppler_peak **peaks);

/* The way from one place on a ring of bins to another, in [-bins / 2, bins / 2]. */
double range_doppler_distance(double to, double from, size_t bins);

/* The root of the power at the bin nearest to a place. */
double range_doppler_amplitude(const struct range_doppler *spectrum, double range, double rate);

#endif
