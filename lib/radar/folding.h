/* Ambiguous readings of range and range rate.
 *
 * A waveform that is repeated every T has unambiguous range rates in [-lambda/(4 T), lambda/(4 T));
 * a train of pulses with the frequency PRF has unambiguous ranges in [0, c/(2 PRF)). Values outside
 * fold into these intervals (MODEL 14.16). Folding is exact: nothing is rounded, and a value inside
 * comes back unchanged. */
#pragma once

/* The range rate as read, in [-unambiguous_mps, unambiguous_mps). unambiguous_mps > 0; infinity
 * folds nothing. */
double folding_range_rate_mps(double range_rate_mps, double unambiguous_mps);

/* The range as read, in [0, unambiguous_m), of range_m >= 0. unambiguous_m > 0; infinity folds
 * nothing. */
double folding_range_m(double range_m, double unambiguous_m);
