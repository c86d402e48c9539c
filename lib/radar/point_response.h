/* What one echo looks like along one axis of a signal's spectrum: its amplitude over the distance
 * from it, in bins, 1 at the echo itself (EFFECTS 4b, 11).
 *
 * POINT_RESPONSE_HANN and POINT_RESPONSE_RECTANGULAR come out of a Fourier transform of as many
 * samples as there are bins, weighted by that window; with their phases counted from the middle
 * sample, kernels are real and change sign from bin to bin. POINT_RESPONSE_PULSE is sampled as it
 * is received: a Gaussian whose amplitude has its half at two bins to both sides. */
#ifndef POINT_RESPONSE_H
#define POINT_RESPONSE_H

#include <stddef.h>

enum point_response { POINT_RESPONSE_HANN, POINT_RESPONSE_RECTANGULAR, POINT_RESPONSE_PULSE };

/* A complex number as libraries for transforms have them. */
struct phasor {
    double re, im;
};

/* The window's weight of sample n of count, periodic; all together they sum to 1. Not for
 * POINT_RESPONSE_PULSE. */
double point_response_weight(enum point_response kernel, size_t n, size_t count);

/* RMS of a bin for independent samples of RMS 1: sqrt(ENBW / count), ENBW 1.5 for Hann, 1 else. */
double point_response_noise(enum point_response kernel, size_t count);

/* sinc d, sinc d / (1 - d^2) or 2^-(d/2)^2, for every d. */
double point_response_value(enum point_response kernel, double bins);

/* A bound on the size of point_response_value that falls with |bins| and is 1 within the main lobe.
 */
double point_response_envelope(enum point_response kernel, double bins);

/* How far from bin `at` an echo stands, from that bin and the two beside it, of channels that see
 * the same echo, `stride` samples apart; exact for one echo alone. Pulses: the vertex of a parabola
 * through the logarithms of their power. Windows: with a, x, b the parts of the three bins in phase
 * with the middle one and g = (a - b)/(2 x + a + b),
 *     d = 2 g/(sqrt(8 g^2 + 1) + 1)  or  d = 2 g/(sqrt(4 g^2 + 9/4) + 3/2)
 * (Macleod's for no window, the same ratio for Hann's). Within [-3/4, 3/4]: an echo beyond has a
 * greater bin next to it. 0 where nothing is received. */
double point_response_offset(enum point_response kernel, const struct phasor *before,
                             const struct phasor *at, const struct phasor *after, size_t channels,
                             size_t stride);

/* Of a long Hann window, a hundred samples or more, with bins of one over its length (no zero
 * padding) and phases counted from its middle, where the response is real: its main lobe is four
 * bins wide, two at half amplitude, and no side lobe exceeds -31.47 dB. */

/* W(d) = sin(pi d)/(pi d (1 - d^2)), the amplitude d bins from an echo of amplitude 1: 1 at 0, 1/2
 * at -1 and 1, exactly 0 at all other whole d, even exactly. |d| <= 2^48, within 4 ulp. */
double point_response_hann(double bins);

/* How many bins behind a peak's bin its echo lies, in [-1/2, 1/2], from the magnitudes of the peak
 * and of the bins next to it, before <= peak >= after, peak > 0 (Grandke): with a the larger
 * neighbour over the peak, (2 a - 1)/(a + 1) towards it. Exact but for rounding for one echo. 0
 * where the neighbours are equal, or both below half of the peak, as only several echoes make them.
 */
double point_response_hann_offset(double before, double peak, double after);

#endif
