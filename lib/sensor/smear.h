/* Cells as a windowed range-Doppler transform would show them.
 *
 * There is no signal (MODEL 6.1): each received echo is spread over the samples around it by the
 * response of a Hann window, W (point_response_hann), and cells are the peaks of the sum. A bin is
 * cell_range_m by cell_range_rate_mps and holds two samples by two, as of a transform that is
 * padded with zeros to twice its length. The sum and delta channel of a sample are the sums over
 * the echoes within three bins of G H W(range) W(rate), with the echoes' phases. What lies farther
 * off, below -41 dB, is left out, and nothing wraps around at ambiguous ranges or rates. An echo
 * that walks (MODEL 14.20) has W(range/f) W(rate/f) with f = 1 + widening, at most 8, within 1 + 2
 * f bins.
 *
 * A peak is a sample whose sum channel none of its eight neighbours exceeds (of equal samples the
 * first by range, then by rate). From the sample nearest to an echo, steps to the strongest
 * neighbour lead to one peak; the echoes that lead to one peak share a cell. So every echo is in
 * one cell. A peak that no echo leads to is a side lobe, and no cell. */
#pragma once

#include "base/hash_table.h"
#include "sensor/resolution_cell.h"

struct smear_sample {
    int64_t range, rate; /* in samples from 0 */
    struct antenna_pointers pointers;
    size_t echoes;    /* how many reach the sample */
    uint64_t effects; /* those of these echoes */
};

struct smear {
    const struct sensor *sensor;
    const struct received_echo *echoes;
    size_t count;
    struct smear_sample *samples;
    size_t sample_count;
    struct hash_table numbers; /* of samples, by their range and rate */
    size_t *cell;              /* the number of each echo's cell */
    size_t *peak; /* each cell's sample; cells are numbered in the order of their first echoes */
    size_t cells;
};

/* Smears count echoes of positive amplitude, strongest first. They must outlive the smear. */
struct smear smear_make(const struct sensor *sensor, const struct received_echo *echoes,
                        size_t count, struct arena *arena);

/* Makes the cell of that number from its peak. Range and range rate are interpolated between bins
 * (point_response_hann_offset); pointers and amplitude, that of the sum channel, are those at the
 * interpolated place; the azimuth is read off the pointers. The members are weighted by their
 * amplitudes. The cell of a single echo is that of resolution_cell_of but for rounding. False if
 * both channels are zero, so that there is no azimuth. */
bool smear_cell(const struct smear *smear, size_t number, struct arena *arena, struct cell *cell);
