/* Directions of echoes from a uniform line of receiving elements (MODEL 11.3). The beam towards the
 * sine s of an azimuth is B(s) = |sum over elements a of x_a exp(-j 2 pi spacing (a - middle) s)|
 * divided by the number of elements. So one echo of amplitude A has a peak of A at its azimuth. */
#pragma once

#include "radar/point_response.h"

enum { BEAMFORMING_MOST_ELEMENTS = 64, BEAMFORMING_MOST_PEAKS = 16 };

struct beamforming_array {
    size_t elements; /* at most BEAMFORMING_MOST_ELEMENTS */
    double spacing;  /* in wavelengths */
};

struct beamforming_peak {
    double sine, amplitude;
};

/* Signal of an echo of amplitude 1 at an element; its phase is 0 in the middle of the array. */
struct phasor beamforming_element_response(const struct beamforming_array *array, double sine,
                                           size_t element);

/* Array factor |sin(N x)/(N sin x)| with x = pi spacing times the distance of two sines: the part
 * of an echo's amplitude that a beam in another direction receives. */
double beamforming_array_factor(const struct beamforming_array *array, double distance);

/* Finds the peaks of B between the sines -limit and limit, strongest first, that have at least the
 * amplitude `least` and half of the strongest; weaker ones may be its side lobes. The elements'
 * samples are stride apart. Returns the number of peaks, at most BEAMFORMING_MOST_PEAKS. The ends
 * of the interval are no peaks. */
size_t beamforming_peaks(const struct beamforming_array *array, const struct phasor *samples,
                         size_t stride, double limit, double least, struct beamforming_peak *peaks);
