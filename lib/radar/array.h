/* Antenna arrays: tapers, beams, and which maxima count (MODEL 7.5).
 *
 * A transmitter and a receiver act like one element at the sum of their places. The beam towards
 * the sine u of an azimuth is
 *
 *     S(u) = sum over n of w_n x_n exp(-2 pi j d m_n u),    m_n = n - (N - 1)/2,
 *
 * with the samples x_n of N elements, d wavelengths apart, and a taper w_n of sum 1. So one echo of
 * amplitude A has a maximum of A at its sine. The transform has 8 N points; its maxima are refined
 * by a parabola in decibels and two Newton steps on |S|^2. */
#pragma once

#include <stdbool.h>

#include "base/arena.h"
#include "radar/point_response.h"

enum { ARRAY_MOST_ELEMENTS = 256, ARRAY_PADDING = 8 };

/* Weights of the elements. HANN is sin^2(pi (n + 1/2)/N). TAYLOR (nbar 4) and CHEBYSHEV have side
 * lobes of -30 dB. */
enum array_taper { TAPER_RECTANGULAR, TAPER_HANN, TAPER_TAYLOR, TAPER_CHEBYSHEV };

/* The place of an element in wavelengths, positive to the left. */
struct array_element {
    double place;
};

/* An array as it is built. The transmitters take turns in their order (TDM). */
struct array_layout {
    LIST_OF(struct array_element) transmit, receive;
    enum array_taper taper;
};

struct array {
    size_t count;                     /* virtual elements; 0: no array */
    double spacing;                   /* mean step from element to element, in wavelengths */
    double least_step, most_step;     /* equal, but for rounding, in an array that has beams */
    size_t turn[ARRAY_MOST_ELEMENTS]; /* the transmitter of each element, from the right */
    double weight[ARRAY_MOST_ELEMENTS];
    double noise;                       /* RMS of a beam's noise if each element's has RMS 1 */
    double signal_moment, noise_moment; /* means of (2 pi m)^2, weighted by w and w^2 */
    double envelope[ARRAY_PADDING * ARRAY_MOST_ELEMENTS / 2 + 1]; /* highest lobe from each step */
    struct phasor root[ARRAY_PADDING * ARRAY_MOST_ELEMENTS];      /* exp(-2 pi j k/(8 N)) */
};

/* A maximum of |S|. */
struct array_maximum {
    double sine, amplitude;
    double sigma;  /* standard deviation of the sine by noise of RMS 1 in a beam */
    double others; /* power in the samples beside one echo of this sine and amplitude */
};

/* The array of a layout with 1 to ARRAY_MOST_ELEMENTS virtual elements. */
struct array array_of(const struct array_layout *layout);

/* The signal at element n of an echo of amplitude 1 from the sine of an azimuth; its phase is 0 in
 * the middle of the array. */
struct phasor array_phasor(const struct array *array, double sine, size_t n);

/* Adds an echo from the sine of an azimuth, with this amplitude and phase in the middle of the
 * array, to the samples of the elements. */
void array_receive(const struct array *array, double sine, struct phasor echo,
                   struct phasor *samples);

/* The maxima of |S| within sines of -1 to 1, the strongest first: at most as many as elements. */
size_t array_maxima(const struct array *array, const struct phasor *samples,
                    struct array_maximum *maxima);

/* Keeps of the maxima, in place, the first one and those that exceed the threshold and stand 3
 * standard deviations of noise above what the side lobes of stronger ones can make there: 1.06
 * times the sum of the taper's envelope of side lobes. noise is the RMS in a beam. Returns the
 * number that is kept. */
size_t array_keep(const struct array *array, double threshold, double noise,
                  struct array_maximum *maxima, size_t count);

/* The mean and the standard deviation of a maximum's `others` by noise of this RMS in a beam,
 * beside one strong echo. */
struct array_others {
    double mean, sigma;
};
struct array_others array_noise_beside(const struct array *array, double noise);

/* |S| of an echo of amplitude 1 at this distance of sines. */
double array_response(const struct array *array, double distance);

/* The standard deviation of the sine of a single echo at this signal-to-noise ratio in a beam, the
 * linear ratio of powers; 0.39/(N d sqrt(snr)) with TAPER_RECTANGULAR. */
double array_sigma(const struct array *array, double snr);

/* The width of a beam on boresight, in sines, where |S|^2 is down to a half: two equal echoes at
 * this distance show as two for about half of all phases between them. */
double array_beam(const struct array *array);
