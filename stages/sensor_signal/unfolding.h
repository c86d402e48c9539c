/* Chooses the true one of range rates that fold alike.
 *
 * The hypotheses are the range rates v + 2 k v_u within the folds of the waveform that put the peak
 * within the sensor's ranges: a chirp measures R + carrier_hz v/slope for the range R, so each has
 * its own range. From a hypothesis follow the place and the phase of the echo in every repetition
 * of the second train, where rates fold at another interval. The second train's samples, turned
 * back by these phases, are added. The hypothesis is chosen whose sum is nearest to the amplitude
 * in the first train; of equal ones the slowest (MODEL 11.3). */
#pragma once

#include "signal_cube.h"

struct unfolding_reading {
    double range_m, range_rate_mps;
};

/* The reading of a peak with this range rate; false if that puts it out of the sensor's ranges. */
bool unfolding_read(const struct signal_cube *signal, const struct range_doppler_peak *peak,
                    double rate_mps, struct unfolding_reading *reading);

/* Chooses the reading of a peak of this amplitude; sine is that of its beam's azimuth, if there are
 * elements. False without a hypothesis. Without a second train the rate is that of the peak, in
 * [-v_u, v_u). */
bool unfolding_choose(const struct signal_cube *signal, const struct range_doppler_peak *peak,
                      double amplitude, double sine, struct unfolding_reading *reading);
