/* Signal of one scan, sample by sample, and its spectrum (MODEL 11.3).
 *
 * A scan is one train of repetitions, or two for a waveform with stagger. `rows` holds the samples
 * of one repetition in all channels: signal_cube_receive makes and weights them, the caller
 * transforms them in place over range (chirps), and signal_cube_store keeps the cells within the
 * sensor's ranges. The caller then transforms the first train over the repetitions into the
 * spectrum; the second train stays as it is.
 *
 * Every echo has the amplitude of the received echo in glint-sensor, and the exact phase of its
 * delay at the sample's instant. Channels weight it with the antenna's sum and delta pointers at
 * its azimuth, or, for an array (radar/array.h), with the magnitude of the sum pointer and the
 * phase of the element's place. Transmitters of an array send one after another in a repetition.
 * pointer_sigma is the RMS noise of a cell after windows and transforms, in a beam of an array, as
 * in glint-noise. Noise of pulses has passed a matched receiver: its correlation over
 * range is their point response. */
#pragma once

#include "base/random.h"
#include "documents/suite.h"
#include "range_doppler.h"

struct received_echo;
struct scan;

/* Cells of the spectrum to a bin; pulses have one along range. */
enum { SIGNAL_CUBE_PADDING = 2 };

struct signal_cube {
    const struct sensor *sensor;
    size_t samples, repetitions, channels;
    enum point_response range_response;
    double range_step_m, rate_step_mps; /* width of a bin */
    double train_s, repetition_s;       /* the first train's length and repetition interval */
    double slope_hzps;                  /* of a chirp; 0 for pulses */
    double chirp_s;                     /* its length, < 0 if the frequency falls; 0 for pulses */
    double coupling;                    /* bins of range that a rate of 1 m/s adds; 0 for pulses */
    double fold_mps;                    /* range rates this far apart share a bin */
    size_t folds;                       /* folds that the second train or the turns tell apart */
    const struct array *array;          /* count 0: the channels are sum and delta */
    size_t turns;                       /* transmitters that take turns in a repetition, or 1 */
    size_t range_padding, row_cells;    /* cells to a bin; cells of a transformed row */
    ptrdiff_t first_cell;               /* first cell kept; below 0: from the row's end on */
    size_t range_cells;                 /* number of cells kept */
    double *weight;                     /* window over the samples */
    struct phasor *tone;                /* scratch: the samples of one echo */
    struct phasor *rows;                /* [channel][row cell]: one repetition */
    struct phasor *spectrum;            /* [channel][rate cell][range cell] */
    struct phasor *second;              /* [channel][repetition][range cell]; NULL: none */
};

/* Input of the receivers in one scan. */
struct signal_input {
    const struct signal_source *sources;
    size_t count;
    struct random_address address; /* of the noise */
    double sigma;                  /* RMS of the noise in a cell; 0: none */
};

/* The cube of a sensor with a waveform. */
struct signal_cube signal_cube_of(const struct sensor *sensor, struct arena *arena);

/* The phase, in turns, that an echo with this range rate has in a channel more than in those of the
 * first transmitter, because the channel's transmitter sends later. */
double signal_cube_turn_phase(const struct signal_cube *signal, size_t channel, double rate_mps);

/* Time of a repetition after the measurement. */
double signal_cube_instant_s(const struct signal_cube *signal, size_t train, size_t repetition);

/* Place of the echo's peak in bins of range, and of rate without folding. */
void signal_cube_place(const struct signal_cube *signal, const struct received_echo *received,
                       double *range, double *rate);

/* The echoes of a scan and, if noisy, its noise. */
struct signal_input signal_cube_input(const struct signal_cube *signal, const struct scan *scan,
                                      bool noisy);

/* The sources of echoes alone. */
struct signal_input signal_cube_sources(const struct signal_cube *signal,
                                        const struct received_echo *received_echoes, size_t count,
                                        struct arena *arena);

/* Makes the samples of one repetition, weighted by both windows and padded with zeros. */
void signal_cube_receive(const struct signal_cube *signal, const struct signal_input *input,
                         size_t train, size_t repetition);

/* Keeps the transformed rows of one repetition. */
void signal_cube_store(const struct signal_cube *signal, size_t train, size_t repetition);

/* The transformed spectrum with its power in every beam: the sum channel, or beams that cover the
 * field of view, half a beam's width apart. An array of several transmitters has them for each of
 * the range rates that fold alike. */
struct range_doppler signal_cube_spectrum(const struct signal_cube *signal, struct arena *arena);
