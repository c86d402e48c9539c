/* What a Hann window makes of one echo on the bins of a Fourier transform, and where between them
 * the echo lies (EFFECTS 4).
 *
 * Bins are those of the transform without zero padding: one over the length of the window. The
 * kernel is that of a long window, a hundred samples or more, counted from its middle, where it is
 * real; its main lobe is four bins wide, two at half amplitude, and no side lobe exceeds -31.47 dB.
 */
#ifndef WINDOW_H
#define WINDOW_H

/* W(d) = sin(pi d)/(pi d (1 - d^2)), the amplitude d bins from an echo of amplitude 1: 1 at 0, 1/2
 * at -1 and 1, exactly 0 at all other whole d, even exactly. |d| <= 2^48, within 4 ulp. */
double window_hann(double bins);

/* How many bins behind a peak's bin its echo lies, in [-1/2, 1/2], from the magnitudes of the peak
 * and of the bins next to it, before <= peak >= after, peak > 0 (Grandke): with a the larger
 * neighbour over the peak, (2 a - 1)/(a + 1) towards it. Exact but for rounding for one echo. 0
 * where the neighbours are equal, or both below half of the peak, as only several echoes make them.
 */
double window_hann_offset(double before, double peak, double after);

#endif
