/* Range, rate, angle and amplitude of a cell, with noise (MODEL 7 to 9, 14). */
#pragma once

#include "noise/target_list.h"

/* Measures a cell as its sensor does: noise is added to the pointers, angle and amplitude are read
 * off them, noise is added to range and range rate, and misalignment and radome turn the azimuth.
 * False if both noisy pointers are zero, so that there is no azimuth. */
bool measurement_noise_read(const struct effect_scan *context, const struct cell *cell,
                            struct effect_measurement *measurement);
