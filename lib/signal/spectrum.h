/* Peaks in a range-Doppler spectrum: where echoes stand in it, and how strong they are (EFFECTS
 * 11).
 *
 * A peak is a cell that no neighbour exceeds in power, all eight of them, with both axes closed to
 * rings. It must stand out as cfar.h says among the rates of its range: along
 * range, walls and rows of posts would hide themselves. Its place is read between the bins and its
 * amplitude there (kernel.h); that must meet the threshold. Stronger peaks are believed first: one
 * that is less than twice of what a stronger one's side lobes can be where it stands, is one of
 * those. */
#ifndef SPECTRUM_H
#define SPECTRUM_H

#include "cfar.h"
#include "kernel.h"
#include "memory.h"

struct spectrum {
    size_t range_bins, rate_bins;
    size_t channels; /* so many read places between the bins */
    enum kernel range_kernel, rate_kernel;
    const struct phasor *samples; /* [channel][rate bin][range bin] */
    const double *power;          /* [rate bin][range bin]: what is seen */
};

struct spectrum_peak {
    size_t range_bin, rate_bin;
    double range, rate; /* in bins; rate from -rate_bins / 2 */
    double gain;        /* of the bin, where the peak has 1 */
    double amplitude;
};

/* Writes the peaks, strongest first; memory comes from the arena. */
size_t spectrum_peaks(const struct spectrum *spectrum, const struct cfar *cfar, double threshold,
                      struct arena *arena, struct spectrum_peak **peaks);

/* The way from one place on a ring of bins to another, in [-bins / 2, bins / 2]. */
double spectrum_distance(double to, double from, size_t bins);

/* The root of the power at the bin nearest to a place. */
double spectrum_amplitude(const struct spectrum *spectrum, double range, double rate);

#endif
