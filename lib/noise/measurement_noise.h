/* What noise makes of one cell's measurement (MODEL 7 to 9, 14). */
#ifndef MEASUREMENT_NOISE_H
#define MEASUREMENT_NOISE_H

#include "noise/target_list.h"

/* Noise on the pointers, the angle and amplitude that are read off them, noise on range and range
 * rate, and the azimuth as it is reported. False if both pointers are zero, so that there is no
 * azimuth. */
bool measurement_noise_read(const struct effect_scan *context, const struct cell *cell,
                            struct measurement *measurement);

/* Only between the azimuth that was read and the one that is reported: misalignment and radome. */
void measurement_noise_turn(const struct effect_scan *context, struct measurement *measurement);

#endif
