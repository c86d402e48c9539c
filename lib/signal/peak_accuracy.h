/* Standard deviations of a detection's place in the signal's spectrum (MODEL 11.3, 14.21). */
#ifndef PEAK_ACCURACY_H
#define PEAK_ACCURACY_H

#include "signal/signal_cube.h"

struct peak_accuracy {
    double range_sigma_m, range_rate_sigma_mps, azimuth_sigma_rad;
};

/* Those of an echo alone at an azimuth, for the power of its peak over that of a bin's noise:
 * by the Cramer-Rao bound of the window and of the elements, or the slope of sum and delta. What
 * chirps read of range goes with the range rate, whose error adds. None is above that of a value
 * anywhere in a cell, or in the field of view. */
struct peak_accuracy peak_accuracy_of(const struct signal_cube *signal, double azimuth_rad,
                                      double snr);

/* How many independent bins of noise the sensor searches: ranges times rates times beams. */
double peak_accuracy_bins(const struct signal_cube *signal);

#endif
