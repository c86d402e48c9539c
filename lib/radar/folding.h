/* Ambiguous readings of range and range rate (MODEL 14.16).
 *
 * Values outside of the unambiguous interval fold into it. Folding is exact; values inside stay. */
#pragma once

/* The range rate as read, in [middle - unambiguous, middle + unambiguous). unambiguous_mps > 0;
 * infinity folds nothing. */
double folding_range_rate_mps(double range_rate_mps, double middle_mps, double unambiguous_mps);

/* The range as read, in [0, unambiguous_m), of range_m >= 0. unambiguous_m > 0; infinity folds
 * nothing. */
double folding_range_m(double range_m, double unambiguous_m);
