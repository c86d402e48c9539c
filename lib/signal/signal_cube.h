/* The signal of one scan, sample by sample, as its receivers put it out (MODEL 11.3; EFFECTS 11).
 *
 * An echo of amplitude A, range R, rate v and phase p makes, in repetition m and sample n,
 *     A exp j(p - 2 pi (v/dv) (m/M - 1/2)) exp -j(2 pi (R_m/dR) (n/N - 1/2))     for chirps,
 *     A exp j(p - 2 pi (v/dv) (m/M - 1/2)) 2^-(2 (n dR - R_m)/w)^2               for pulses,
 * with R_m = R + v (m/M - 1/2) wavelength/(2 dv): it moves on from one repetition to the next. The
 * carrier is the middle of a chirp, and the instant of the measurement the middle of the scan.
 * Transforms with a positive exponent over n (of chirps) and m then show it at the bins R/dR and
 * v/dv of A. Every channel weights it: the antenna's sum and delta pointers at its azimuth, or, for
 * a row of elements, the sum pointer's size for all and the phase of their places.
 *
 * A is a reception's: what one echo alone has in glint-sensor. pointer_sigma is the noise of a cell
 * after windows and transforms, and over all elements together: what it is in glint-noise. The
 * noise of pulses went through a receiver that fits them, so that its correlation over range is
 * their kernel. */
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
    enum point_response range_kernel;
    double range_step_m, rate_step_mps; /* from bin to bin */
    struct beamforming_array array;     /* elements 0: sum and delta channel */
    struct phasor *cube;                /* [channel][repetition][sample] */
    struct phasor *row;                 /* room for one repetition of samples */
};

/* Of a sensor with a waveform; cube and row are the caller's to give. */
struct signal_cube signal_cube_of(const struct sensor *sensor);
size_t signal_cube_size(const struct signal_cube *signal);

/* A silent signal. */
void signal_cube_clear(const struct signal_cube *signal);

/* Adds echoes. Memory comes from the arena. */
void signal_cube_add(const struct signal_cube *signal, const struct received_echo *received_echoes,
                     size_t count, struct arena *arena);

/* Adds noise that leaves cells with this RMS in the sum and delta channel, or beams of all
 * elements. */
void signal_cube_add_noise(const struct signal_cube *signal, const struct random_address *address,
                           double sigma);

/* Applies the windows. */
void signal_cube_weigh(const struct signal_cube *signal);

/* All of it, for what a scan received: ready for the transforms. */
void signal_cube_receive(const struct signal_cube *signal, const struct scan *scan, bool noisy);

/* What the transformed cube is. Its power is that of the sum channel, or of the strongest of beams
 * that cover the field of view half a beam's width apart. Memory comes from the arena. */
struct range_doppler signal_cube_spectrum(const struct signal_cube *signal, struct arena *arena);

/* Between such beams an echo shows at least this part of its amplitude. */
#define SIGNAL_CUBE_BETWEEN_BEAMS 0.9

#endif
