/* Row of receiving elements of a waveform, and its peaks (MODEL 11.3). The beam towards the
 * sine s of an azimuth is B(s) = |sum over elements a of x_a exp(-j 2 pi spacing (a - middle) s)|
 * divided by the number of elements. So one echo of amplitude A has a peak of A at its azimuth. */
#pragma once

#include "radar/point_response.h"

enum { ELEMENT_ROW_MOST_ELEMENTS = 64, ELEMENT_ROW_MOST_PEAKS = 16 };

struct element_row {
    size_t elements; /* at most ELEMENT_ROW_MOST_ELEMENTS */
    double spacing;  /* in wavelengths */
};

struct element_row_peak {
    double sine, amplitude;
};

/* Signal of an echo of amplitude 1 at an element; its phase is 0 in the middle of the array. */
struct phasor element_row_response(const struct element_row *array, double sine, size_t element);

/* Array factor |sin(N x)/(N sin x)| with x = pi spacing times the distance of two sines: the part
 * of an echo's amplitude that a beam in another direction receives. */
double element_row_factor(const struct element_row *array, double distance);

/* Finds the peaks of B between the sines -limit and limit, strongest first, that have at least the
 * amplitude `least` and half of the strongest; weaker ones may be its side lobes. The elements'
 * samples are stride apart. Returns the number of peaks, at most ELEMENT_ROW_MOST_PEAKS. The ends
 * of the interval are no peaks. */
size_t element_row_peaks(const struct element_row *array, const struct phasor *samples,
                         size_t stride, double limit, double least, struct element_row_peak *peaks);
