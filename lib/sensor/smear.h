/* What a windowed range-Doppler transform shows of a scan's received echoes, without the signal:
 * every received echo smeared by the window's kernel over the bins around it, and the peaks of the
 * sum (EFFECTS 4).
 *
 * A bin is cell_range_m by cell_range_rate_mps, and there are two samples in a bin, as of a
 * transform that is padded with zeros to twice its length. Sum and delta channel of a sample are
 * the sums over the received echoes within three bins of G H W(range) W(rate), with the received
 * echoes' phases, W being point_response_hann; what lies farther off, below -41 dB, is left out,
 * and nothing wraps around.
 *
 * A peak is a sample whose sum channel is no weaker than that of its eight neighbours (of equal
 * ones the first by range, then by rate). From the sample next to it every received echo leads
 * uphill, each step to the strongest neighbour, to one peak: the received echoes that meet there
 * share a cell. So every received echo is in one cell; a peak that no received echo leads to, a
 * side lobe, is none. */
#ifndef SMEAR_H
#define SMEAR_H

#include "sensor/resolution_cell.h"

struct smear_sample {
    int64_t range, rate; /* in samples from 0 */
    struct antenna_pointers pointers;
    size_t received_echoes; /* that reach it */
    uint64_t effects;       /* of these */
};

struct smear {
    const struct sensor *sensor;
    const struct received_echo *received_echoes;
    size_t count;
    struct smear_sample *samples;
    size_t sample_count;
    uint32_t *slot; /* a hash table of samples by their numbers, counted from 1; 0: empty */
    size_t slots;   /* a power of two */
    size_t *cell;   /* of every received echo */
    size_t *peak; /* of every cell; cells are numbered in the order of their first received echo */
    size_t cells;
};

/* Rays strongest first; their amplitudes are positive. They must outlive the smear. */
struct smear smear_make(const struct sensor *sensor, const struct received_echo *received_echoes,
                        size_t count, struct arena *arena);

/* The cell of that number as its peak shows it: range and rate interpolated
 * (point_response_hann_offset), pointers and amplitude, that of the sum channel, as they are there,
 * the azimuth read off them. For a single received echo all is that of resolution_cell_of but for
 * rounding. Members are the received echoes, weighted by their amplitudes. False if both channels
 * are zero. */
bool smear_cell(const struct smear *smear, size_t number, struct arena *arena, struct cell *cell);

#endif
