/* What a radar reads of a range rate or a range beyond what it can tell apart (EFFECTS 10).
 *
 * A waveform repeated every T resolves range rates from -lambda/(4 T) up to lambda/(4 T); a train
 * of pulses at frequency PRF resolves ranges up to c/(2 PRF). What lies outside shows where it
 * folds to, exactly: no rounding, and what lies inside comes back bit by bit. Its amplitude stays
 * that of the true range. */
#ifndef FOLDING_H
#define FOLDING_H

/* In [-unambiguous, unambiguous); unambiguous > 0, and infinity folds nothing. */
double folding_range_rate_mps(double range_rate_mps, double unambiguous_mps);

/* In [0, unambiguous), for range >= 0; unambiguous > 0, and infinity folds nothing. */
double folding_range_m(double range_m, double unambiguous_m);

#endif
