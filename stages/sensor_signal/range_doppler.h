/* Peaks of a range-Doppler spectrum that are no side lobes (MODEL 11.3).
 *
 * A spectrum has one map of power for every beam. Its cells come from transforms padded with zeros,
 * range_padding by rate_padding to a bin. The axis of rates is a ring; that of ranges is one if all
 * cells of a row are kept.
 *
 * A peak is a cell whose strongest beam has at least the power of the eight neighbours. In at least
 * one beam it must reach the CFAR threshold (cfar.h), which is taken along range rate: along range,
 * walls and rows of posts would hide themselves. Place and amplitude are interpolated between the
 * cells (point_response.h). A peak outside the main lobe of a stronger peak counts as a side lobe
 * of it, unless it is at least twice as high as a side lobe can be there. */
#pragma once

#include <stdbool.h>

#include "base/arena.h"
#include "radar/cfar.h"
#include "radar/point_response.h"

struct range_doppler {
    size_t range_cells, rate_cells, beams;
    size_t range_padding, rate_padding; /* cells to a bin */
    size_t range_bins;                  /* of a whole row */
    bool range_ring;
    double first_cell; /* number of the first range cell; below 0 before range 0 */
    enum point_response range_response, rate_response;
    const double *power;     /* [beam][rate cell][range cell] */
    const double *strongest; /* [rate cell][range cell]: the most of all beams */
};

struct range_doppler_peak {
    size_t range_cell, rate_cell, beam;
    double range, rate; /* in bins; rate from minus half of the bins on */
    double gain;        /* response at the cell relative to that at the peak */
    double amplitude, threshold;
};

/* Finds the peaks of at least this amplitude, strongest first, and returns their number. */
size_t range_doppler_peaks(const struct range_doppler *spectrum, const struct cfar *cfar,
                           double least, struct arena *arena, struct range_doppler_peak **peaks);

/* Distance, with its sign, between places on a ring of bins, in [-bins / 2, bins / 2]. */
double range_doppler_distance(double to, double from, size_t bins);

/* Replaces a place in bins by its distances from a peak on both axes. */
void range_doppler_away(const struct range_doppler *spectrum, const struct range_doppler_peak *peak,
                        double *range, double *rate);

/* The cell nearest to a place as a peak, with its amplitude and threshold in the beam that decides.
 * Beyond the ends of the spectrum its last cell counts. */
struct range_doppler_peak range_doppler_at(const struct range_doppler *spectrum,
                                           const struct cfar *cfar, double range, double rate);
