/* Response of range or Doppler processing to a single echo.
 *
 * The response is the amplitude along one axis of the spectrum, over the distance from the echo in
 * bins; it is 1 at the echo (MODEL 6.1, 11.3). HANN and RECTANGULAR are the Fourier transforms of
 * as many samples as there are bins, weighted by that window. With phases counted from the middle
 * sample they are real and change sign from bin to bin. PULSE is a Gaussian pulse, sampled as it is
 * received, with the amplitude 1/2 two bins to either side. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

enum point_response { POINT_RESPONSE_HANN, POINT_RESPONSE_RECTANGULAR, POINT_RESPONSE_PULSE };

/* A complex number in the layout of transform libraries. */
struct phasor {
    double re, im;
};

/* The window's weight of sample n of count, periodic; the weights sum to 1. Not for PULSE. */
double point_response_weight(enum point_response response, size_t n, size_t count);

/* The RMS of a bin if all samples have independent noise of RMS 1: sqrt(ENBW / count), with the
 * equivalent noise bandwidth ENBW = 1.5 for HANN, else 1. */
double point_response_noise(enum point_response response, size_t count);

/* The response at any distance d = bins: sinc d for RECTANGULAR, sinc d / (1 - d^2) for HANN,
 * 2^-(d/2)^2 for PULSE. */
double point_response_value(enum point_response response, double bins);

/* Distance from the peak to the first null, in bins: 2 for HANN, 1 for RECTANGULAR, infinite for
 * PULSE, which has no side lobes. */
double point_response_main_lobe(enum point_response response);

/* The resolution, in bins: 1.775 for HANN, 0.997 for RECTANGULAR, 3.580 for PULSE. At this distance
 * from an echo of twice its amplitude, an echo has a peak of its own for half of all phases between
 * the two. The last of these phases is quadrature, where their powers add. */
double point_response_resolution(enum point_response response);

/* True if the sum of two pulses, so many bins > 0 apart, has two peaks (MODEL 6). ratio > 0 is that
 * of their amplitudes. Equal pulses have two beyond 2 sqrt((1 + cos phase_rad)/ln 2) bins, opposite
 * ones always. */
bool point_response_pulses_part(double bins, double ratio, double phase_rad);

/* An upper bound on the size of point_response_value that does not rise with |bins|; 1 within the
 * main lobe. */
double point_response_envelope(enum point_response response, double bins);

/* The response with a Hann window of a hundred samples or more, W(d) = sin(pi d)/(pi d (1 - d^2)):
 * 1 at 0, 1/2 at -1 and 1, exactly 0 at all other whole numbers, and exactly even. Its main lobe is
 * four bins wide, two at half amplitude, and no side lobe exceeds -31.47 dB. |bins| <= 2^48; within
 * 4 ulp. */
double point_response_hann(double bins);

/* The place of an echo relative to the bin of its peak with Hann's window, in bins, in [-1/2, 1/2]
 * (Grandke 1983). From the magnitudes before <= peak >= after, peak > 0: (2 a - 1)/(a + 1) towards
 * the larger neighbour, which is a times the peak. For one echo it is exact but for rounding. It is
 * 0 if both neighbours are equal, or both below half of the peak, as several echoes can be. */
double point_response_hann_offset(double before, double peak, double after);

/* The place of an echo relative to the cell of its peak, in cells, in [-1/2, 1/2]: the vertex of
 * the parabola through the logarithms of the powers, or magnitudes, of the peak and its neighbours.
 * It is 0 if a neighbour is 0. For one echo it is exact for pulses; with two cells to a bin it is
 * within 0.0017 bins with Hann's window and 0.0104 without. For a response of Hann's shape that is
 * wider than it (MODEL 14.20), and an echo at most a quarter of a bin off, it is within 0.016 bins,
 * the nearer the wider the response is. */
double point_response_vertex(double before, double peak, double after);

/* An echo that walks while it is measured: the level of its strongest point, 1 at rest, and its
 * width at half that level, 1 + widening times the width at rest. */
struct point_response_walk {
    double level, widening;
};

/* The response to an echo that walks so many cells of range in a dwell, in either direction. The
 * phase is bilinear over both axes of the samples. With a window w of integral 1 on each axis,
 *
 *     response(a, b) = integral of w(x) w(y) exp 2 pi j (K x y + a x + b y) over [-1/2, 1/2]^2,
 *
 * is lower and wider than at rest, in range and range rate alike (MODEL 14.20). For HANN the answer
 * is within 0.02 dB and 0.03 cells of the integral; for RECTANGULAR, up to 10 cells, within 0.3 dB
 * and 0.2 cells. Below 1e-8 cells there is no change. Not for PULSE. */
struct point_response_walk point_response_of_walk(enum point_response response, double cells);
