/* Errors beside MPFR. */
#pragma once

#include <math.h>

#include <mpfr.h>

/* |result - exact|. */
static inline double error_size(double result, const mpfr_t exact)
{
    mpfr_t error;
    mpfr_init2(error, mpfr_get_prec(exact));
    mpfr_sub_d(error, exact, result, MPFR_RNDN);
    double size = fabs(mpfr_get_d(error, MPFR_RNDN));
    mpfr_clear(error);
    return size;
}

/* The error of a result in units in the last place of the exact one; subnormal results share one
 * unit. */
static inline double error_ulp(double result, const mpfr_t exact)
{
    if (mpfr_zero_p(exact))
        return result == 0 ? 0 : (double)INFINITY;
    long exponent = mpfr_get_exp(exact) < -1021 ? -1021 : (long)mpfr_get_exp(exact);
    mpfr_t error;
    mpfr_init2(error, mpfr_get_prec(exact));
    mpfr_sub_d(error, exact, result, MPFR_RNDN);
    mpfr_mul_2si(error, error, 53 - exponent, MPFR_RNDN);
    double ulp = fabs(mpfr_get_d(error, MPFR_RNDN));
    mpfr_clear(error);
    return ulp;
}
