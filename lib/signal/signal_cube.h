/* Signal of one scan, sample by sample, before the transforms (MODEL 11.3).
 *
 * An echo of amplitude A, range R, range rate v and phase p makes, in repetition m and sample n,
 *
 *     A exp j(p - 2 pi (v/dv) (m/M - 1/2)) exp -j(2 pi (R_m/dR) (n/N - 1/2))     for chirps,
 *     A exp j(p - 2 pi (v/dv) (m/M - 1/2)) 2^-(2 (n dR - R_m)/w)^2               for pulses,
 *
 * with R_m = R + v (m/M - 1/2) wavelength/(2 dv): it moves from one repetition to the next. The
 * carrier is the middle of a chirp, and the instant of the measurement the middle of the scan.
 * Transforms with a positive exponent over n (of chirps) and m then give it the amplitude A at the
 * bins R/dR and v/dv. Every channel weights the echo: with the antenna's sum and delta pointers at
 * its azimuth, or, for a row of elements, with the magnitude of the sum pointer and the phase of
 * the element's place.
 *
 * A is the amplitude of the received echo in glint-sensor. pointer_sigma is the RMS noise of a cell
 * after windows and transforms, over all elements together, as in glint-noise. The noise of pulses
 * has passed a matched receiver, so that its correlation over range is their point response. */
#ifndef SIGNAL_CUBE_H
#define SIGNAL_CUBE_H

#include "base/random.h"
#include "documents/suite.h"
#include "signal/beamforming.h"
#include "signal/range_doppler.h"

struct received_echo;
struct scan;

struct signal_cube {
    const struct sensor *sensor;
    size_t samples, repetitions, channels;
    enum point_response range_response;
    double range_step_m, rate_step_mps; /* distance between bins */
    struct beamforming_array array;     /* elements 0: the channels are sum and delta */
    struct phasor *cube;                /* [channel][repetition][sample] */
    struct phasor *row;                 /* scratch for the samples of one repetition */
};

/* The cube of a sensor with a waveform; the caller allocates cube, of signal_cube_size, and row. */
struct signal_cube signal_cube_of(const struct sensor *sensor);
size_t signal_cube_size(const struct signal_cube *signal);

/* Sets all samples to zero. */
void signal_cube_clear(const struct signal_cube *signal);

/* Adds echoes; memory comes from the arena. */
void signal_cube_add(const struct signal_cube *signal, const struct received_echo *received_echoes,
                     size_t count, struct arena *arena);

/* Adds noise with this RMS in each cell of the sum and delta channel, or of beams of all elements,
 * after windows and transforms. */
void signal_cube_add_noise(const struct signal_cube *signal, const struct random_address *address,
                           double sigma);

/* Multiplies the samples by the windows. */
void signal_cube_apply_windows(const struct signal_cube *signal);

/* Clears the cube, adds the echoes of a scan and its noise, if noisy, and applies the windows: the
 * cube is then ready for the transforms. */
void signal_cube_receive(const struct signal_cube *signal, const struct scan *scan, bool noisy);

/* The spectrum of the transformed cube. Its power is that of the sum channel, or of the strongest
 * of beams that cover the field of view, half a beam's width apart. Memory comes from the arena. */
struct range_doppler signal_cube_spectrum(const struct signal_cube *signal, struct arena *arena);

/* Between such beams an echo has at least this part of its amplitude. */
#define SIGNAL_CUBE_BETWEEN_BEAMS 0.9

#endif
