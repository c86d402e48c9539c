/* Cells as a windowed range-Doppler transform would show them.
 *
 * There is no signal: cells are the peaks of the sum of the echoes' responses (MODEL 6.1). What
 * lies more than three bins off an echo, below -41 dB, is left out, and nothing wraps around at
 * ambiguous ranges or rates. An echo that walks (MODEL 14.20) has W(range/f) W(rate/f) with f = 1 +
 * widening, at most 8, within 1 + 2 f bins. Of equal samples the first by range, then by rate, is
 * the peak. Every echo is in one cell. A peak that no echo leads to is a side lobe, and no cell. */
#pragma once

#include "base/hash.h"
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
