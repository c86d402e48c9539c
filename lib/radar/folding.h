/* Ambiguous readings of range and range rate (MODEL 14.16).
 *
 * Values outside of the unambiguous intervals fold into these. Folding is exact: nothing is
 * rounded, and a value inside comes back unchanged. */
#pragma once

/* The range rate as read, in [-unambiguous_mps, unambiguous_mps). unambiguous_mps > 0; infinity
 * folds nothing. */
double folding_range_rate_mps(double range_rate_mps, double unambiguous_mps);

/* The range as read, in [0, unambiguous_m), of range_m >= 0. unambiguous_m > 0; infinity folds
 * nothing. */
double folding_range_m(double range_m, double unambiguous_m);
