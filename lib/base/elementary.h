/* Elementary functions with the same bytes on every machine. They use only + - * / sqrt,
 * comparisons and integer operations. IEEE 754 defines the results of these to the bit, so no
 * compiler, C library or CPU changes one. They need round-to-nearest and no contraction of products
 * and sums; the Makefile's flags give both. tests/tools/check-house refuses libm's functions.
 *
 * Errors are in units in the last place (ulp) of the exact result; 0.5 ulp is correct rounding.
 * tests/unit/base/test_elementary measures them against MPFR. */
#pragma once

#include <math.h>
#include <stdint.h>
#include <string.h>

struct elementary_sincos {
    double sin, cos;
};

/* Sine and cosine of every finite angle, also of 1e300 rad, within 0.9 ulp. The sine is exactly
 * odd, the cosine exactly even; NaN for infinities. */
double elementary_sin(double angle_rad);
double elementary_cos(double angle_rad);

/* The same two doubles, for little more than the cost of one. */
struct elementary_sincos elementary_sincos(double angle_rad);

/* The angle minus a multiple of the exact 2 pi, from -PI to PI as doubles, within 0.6 ulp for every
 * finite angle. An angle in this range is returned unchanged. Exactly odd; NaN for infinities. */
double elementary_wrap(double angle_rad);

/* Sine and cosine of 2 pi turns, |turns| <= 2^48, within 0.9 ulp: whole, half and quarter turns are
 * exact. */
struct elementary_sincos elementary_sincos_turns(double turns);

/* The angle of the point (x, y), within 0.6 ulp, from -PI to PI as doubles; signed zeros and
 * infinities as in C's atan2. Exactly odd in y. */
double elementary_atan2(double y, double x);

/* The arc sine within 0.8 ulp; exactly odd; NaN outside [-1, 1]. */
double elementary_asin(double sine);

/* Logarithms to the bases e and 10 for x >= 0; -infinity at 0, NaN below. elementary_log is within
 * 0.9 ulp, elementary_log10 within 0.6 and exact where x is a power of ten. */
double elementary_log(double x);
double elementary_log10(double x);

/* e^x within 0.9 ulp, or within 2^-1074 where the result is subnormal; 0 or infinity where the
 * result is no double. */
double elementary_exp(double x);

/* base^exponent for base >= 0 and a finite exponent, NaN otherwise; within 1 ulp, correctly rounded
 * for the exponents 1, 2 and 1/2, within 1.3 ulp for 3/2. */
double elementary_pow(double base, double exponent);

/* sqrt(x^2 + y^2) without overflow or underflow on the way, within 1.2 ulp; exact where x or y is
 * 0. */
double elementary_hypot(double x, double y);

/* x 2^exponent; a subnormal result is rounded once. */
static inline double elementary_scaled(double x, int exponent)
{
    if (exponent < -1022 || exponent > 1023)
        return scalbn(x, exponent);
    double power;
    memcpy(&power, &(uint64_t){(uint64_t)(exponent + 1023) << 52}, sizeof power);
    return x * power;
}

/* The lesser and the greater of two numbers. Of equal numbers the first: fmin and fmax leave open
 * which of two zeros of different sign they return. Of a NaN and a number, the number. */
static inline double elementary_min(double a, double b)
{
    return b < a || isnan(a) ? b : a;
}

static inline double elementary_max(double a, double b)
{
    return b > a || isnan(a) ? b : a;
}
