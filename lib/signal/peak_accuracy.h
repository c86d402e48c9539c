/* Standard deviations of a detection's place in the signal's spectrum (MODEL 11.3, 14.21). */
#pragma once

#include "signal/signal_cube.h"

/* Powers over that of a bin's noise, >= 0: in the cell of the spectrum where the peak was found,
 * and there in the beam of the detection. Elsewhere in its bin an echo is weaker than at its place.
 */
struct peak_snr {
    double found, in_beam;
};

struct peak_accuracy {
    double range_sigma_m, range_rate_sigma_mps, azimuth_sigma_rad;
};

/* Those of an echo alone at an azimuth: by the Cramer-Rao bound of the window and of the elements,
 * or by the slope of sum and delta. What chirps read of range goes with the range rate, whose error
 * adds. Each is at most that of a value anywhere in a cell, or in the field of view. */
struct peak_accuracy peak_accuracy_of(const struct signal_cube *signal, double azimuth_rad,
                                      struct peak_snr snr);

/* How many independent bins of noise the sensor searches: ranges times rates times beams. */
double peak_accuracy_bins(const struct signal_cube *signal);
