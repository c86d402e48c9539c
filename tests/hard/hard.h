/* One hard case: the errors of the plain form and of glint's against the exact answer, and the
 * bound on glint's.
 *
 * Cases carry the numbers of README.md beside this file, 1 to 64; what has no number is named.
 * Exact answers are MPFR's, computed in the test. Every case prints one row, which scripts/numerics
 * collects, and fails if glint's error is beyond its bound. */
#pragma once

#include "support/check.h"
#include "support/sample.h"
#include "support/ulp.h"

#include <mpfr.h>

/* The number of points to test: all, or a tenth of them where HARD_TENTH is set, as in builds with
 * sanitizers. */
static inline int hard_points(int all)
{
    return getenv("HARD_TENTH") != NULL ? (all + 9) / 10 : all;
}

/* The greater of two errors, where NaN is the greatest. */
static inline double hard_worse(double error, double other)
{
    return isnan(error) || other <= error ? error : other;
}

/* Prints the row of one case: naive and ours are the worst errors over its points of the plain form
 * and of glint's, in unit ("ulp", "rad", "m", "wrong of 1e6"); NaN is written as such. Fails unless
 * ours <= bound. */
static inline void hard_case(const char *number, const char *title, const char *unit, double naive,
                             double ours, double bound)
{
    print_message("hard\t%s\t%s\t%s\t%.2g\t%.2g\t%.2g\n", number, title, unit, naive, ours, bound);
    if (!(ours <= bound))
        fail_msg("case %s, %s: %.17g %s, at most %.17g allowed", number, title, ours, unit, bound);
}
