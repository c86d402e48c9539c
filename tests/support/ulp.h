/* Errors beside MPFR. */
#pragma once

#include <math.h>

#include <mpfr.h>

/* The error of a result in units in the last place of the exact one, which is used up; subnormal
 * results share one unit. */
static inline double error_ulp(double result, mpfr_t exact)
{
    if (mpfr_zero_p(exact))
        return result == 0 ? 0 : (double)INFINITY;
    long exponent = mpfr_get_exp(exact) < -1021 ? -1021 : (long)mpfr_get_exp(exact);
    mpfr_sub_d(exact, exact, result, MPFR_RNDN);
    mpfr_mul_2si(exact, exact, 53 - exponent, MPFR_RNDN);
    return fabs(mpfr_get_d(exact, MPFR_RNDN));
}
