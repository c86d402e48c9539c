/* Elementary functions with the same bytes on every machine. They use + - * / sqrt, comparisons and
 * integer operations alone, all of which IEEE 754 rounds exactly, so that neither the compiler, the
 * optimization, the C library nor the CPU can change a result. They need round-to-nearest and no
 * contraction of products and sums; the Makefile's flags give both. scripts/check-house keeps
 * libm's functions out.
 *
 * The bounds are in units in the last place of the exact result, with 0.5 for a correctly rounded
 * one. tests/unit/base/test_elementary measures them against MPFR, over logarithmic draws of the
 * whole domain and densely at the hard places of each function. */
#pragma once

#include <math.h>
#include <stdint.h>
#include <string.h>

struct elementary_sincos {
    double sin, cos;
};

/* For every finite angle, 1e300 rad too; within 0.9 ulp. Odd and even exactly; NaN for
 * infinities. */
double elementary_sin(double angle_rad);
double elementary_cos(double angle_rad);

/* Both for little more than the cost of one: the same doubles as elementary_sin and
 * elementary_cos. */
struct elementary_sincos elementary_sincos(double angle_rad);

/* The angle less whole turns (of 2 pi, not of its double), from -PI to PI as doubles. Every finite
 * angle within 0.6 ulp; angles already in the range unchanged. Odd exactly; NaN for infinities. */
double elementary_wrap(double angle_rad);

/* Sine and cosine of 2 pi turns, |turns| <= 2^48, within 0.9 ulp: whole, half and quarter turns are
 * exact. */
struct elementary_sincos elementary_sincos_turns(double turns);

/* The angle of (x, y), within 0.6 ulp, from -PI to PI as doubles; signed zeros and infinities as in
 * C's atan2. Odd in y exactly. */
double elementary_atan2(double y, double x);

/* Within 0.8 ulp; odd exactly; NaN beyond [-1, 1]. */
double elementary_asin(double sine);

/* For x >= 0; -infinity at 0, NaN below. elementary_log is within 0.9 ulp, elementary_log10 within
 * 0.6 and exact where x is a power of ten. */
double elementary_log(double x);
double elementary_log10(double x);

/* Within 0.9 ulp, and within 1 unit of the subnormals where the result is one; 0 or infinity where
 * it leaves the doubles. */
double elementary_exp(double x);

/* base^exponent for base >= 0 and a finite exponent, NaN otherwise; within 1 ulp, correctly rounded
 * for the exponents 1, 2 and 1/2, within 1.3 ulp for 3/2. */
double elementary_pow(double base, double exponent);

/* sqrt(x^2 + y^2) without overflow or underflow on the way, within 1.2 ulp; exact where x or y is
 * 0. */
double elementary_hypot(double x, double y);

/* x 2^exponent, rounded once where it is subnormal: a product where the power is a normal double,
 * else scalbn. */
static inline double elementary_scaled(double x, int exponent)
{
    if (exponent < -1022 || exponent > 1023)
        return scalbn(x, exponent);
    double power;
    memcpy(&power, &(uint64_t){(uint64_t)(exponent + 1023) << 52}, sizeof power);
    return x * power;
}

/* The lesser and the greater of two numbers; of equal ones the first, so that two zeros of
 * different sign have one answer, which fmin and fmax leave open. Of a NaN and a number, the
 * number. */
static inline double elementary_min(double a, double b)
{
    return b < a || isnan(a) ? b : a;
}

static inline double elementary_max(double a, double b)
{
    return b > a || isnan(a) ? b : a;
}
