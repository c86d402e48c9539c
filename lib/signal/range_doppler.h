/* Peaks of a range-Doppler spectrum that are no side lobes (MODEL 11.3).
 *
 * A spectrum has one map of power for every beam. Its cells are those of transforms padded with
 * zeros, range_padding by rate_padding to a bin. The axis of rates is a ring, and so is that of
 * ranges if it has all cells of a row.
 *
 * A peak is a cell that none of its eight neighbours exceeds in the power of its strongest beam. In
 * one of its beams it must exceed the CFAR threshold (cfar.h) among the range rates of its range;
 * along range, walls and rows of posts would hide themselves. Its place is interpolated between the
 * cells, and its amplitude is that at this place (point_response.h). A peak outside the main lobe
 * of a stronger peak is taken for one of its side lobes, unless it is at least twice as high as a
 * side lobe can be at that place. */
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
    double amplitude;
    double threshold; /* the least amplitude of a peak here */
};

/* Finds the peaks of at least this amplitude, strongest first, and returns their number; memory
 * comes from the arena. */
size_t range_doppler_peaks(const struct range_doppler *spectrum, const struct cfar *cfar,
                           double least, struct arena *arena, struct range_doppler_peak **peaks);

/* The distance, with its sign, from one place on a ring of bins to another, in [-bins / 2, bins /
 * 2]. */
double range_doppler_distance(double to, double from, size_t bins);

/* The same between a place and a peak's on each axis. */
double range_doppler_range_away(const struct range_doppler *spectrum, double range,
                                const struct range_doppler_peak *peak);
double range_doppler_rate_away(const struct range_doppler *spectrum, double rate,
                               const struct range_doppler_peak *peak);

/* The peak that the cell nearest to a place would be, in the beam that decides, with that cell's
 * amplitude and threshold. A range outside the spectrum counts as its nearest cell. */
struct range_doppler_peak range_doppler_at(const struct range_doppler *spectrum,
                                           const struct cfar *cfar, double range, double rate);
