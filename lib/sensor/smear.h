/* Cells as a windowed range-Doppler transform would show them.
 *
 * No signal is computed: cells are the peaks of the sum of the echoes' responses (MODEL 6.1). The
 * response of an echo ends three bins off it, below -41 dB, and does not wrap around at ambiguous
 * ranges or rates. The response of an echo with range migration (MODEL 14.20) is W(range/f)
 * W(rate/f) with f = 1 + widening, at most 8, and ends 1 + 2 f bins off it. Every echo is in one
 * cell: the peak that is reached from it uphill. Of equal samples the first by range, then by rate,
 * counts as the higher. A peak that is reached from no echo is a side lobe, and no cell. */
#pragma once

#include "base/hash.h"
#include "sensor/resolution_cell.h"

struct smear_sample {
    int64_t range, rate; /* in samples from 0 */
    struct antenna_pointers pointers;
    size_t echoes;    /* number of echoes that reach the sample */
    uint64_t effects; /* of these echoes */
};

struct smear {
    const struct sensor *sensor;
    const struct received_echo *echoes;
    size_t count;
    struct smear_sample *samples;
    size_t sample_count;
    struct hash_table numbers; /* of samples, by range and rate */
    size_t *cell;              /* number of the cell of each echo */
    size_t *peak;              /* sample of each cell, in the order of the cells' first echoes */
    size_t cells;
};

/* Smears count echoes of positive amplitude, strongest first. They must outlive the smear. */
struct smear smear_make(const struct sensor *sensor, const struct received_echo *echoes,
                        size_t count, struct arena *arena);

/* Makes a cell from its peak. Range and range rate are interpolated between bins
 * (point_response_hann_offset). Pointers and amplitude, which is that of the sum channel, are taken
 * at the interpolated place; the azimuth follows from the pointers. Members are weighted by their
 * amplitudes. The cell of a single echo is that of resolution_cell_of but for rounding. False as
 * resolution_cell_measure. */
bool smear_cell(const struct smear *smear, size_t number, struct arena *arena, struct cell *cell);
