/* Which of the range rates that fold alike is true.
 *
 * The hypotheses are the range rates v + 2 k v_u within the folds of the waveform that put the peak
 * at a range the sensor measures: a chirp reads the range R of an echo as R + carrier_hz v/slope,
 * so that each has a range of its own. A hypothesis foretells the place and the phase of the echo
 * in every repetition of the second train, in which rates fold at another interval. With these
 * phases taken off, the second train's samples add up to an amplitude. The hypothesis whose
 * amplitude is nearest to that in the first train is chosen; of equal ones the slowest
 * (MODEL 11.3). */
#pragma once

#include "signal/signal_cube.h"

struct unfolding_reading {
    double range_m, range_rate_mps;
};

/* Chooses for a peak of this amplitude in a beam at the sine of an azimuth; without elements sine
 * does not count. False if there is no hypothesis. Without a second train the rate is that of the
 * peak, in [-v_u, v_u). */
bool unfolding_choose(const struct signal_cube *signal, const struct range_doppler_peak *peak,
                      double amplitude, double sine, struct unfolding_reading *reading);
