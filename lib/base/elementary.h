/* Elementary functions whose bytes are the same everywhere: + - * / sqrt, comparisons and integer
 * operations alone, all of which IEEE 754 rounds exactly, so that neither the compiler, the
 * optimization, the C library nor the CPU can change a result (NUMERICS A6). Needs round-to-nearest
 * and no contraction; the house's flags see to both. scripts/check-house keeps libm's out.
 *
 * The bounds are in units in the last place of the exact result, with 0.5 for a correctly rounded
 * one; tests/test_elementary measures them against MPFR, over logarithmic draws of the whole domain
 * and densely at the hard places of each function. */
#ifndef ELEMENTARY_H
#define ELEMENTARY_H

#include <math.h>
#include <stdint.h>
#include <string.h>

struct elementary_sincos {
    double sin, cos;
};

/* Every finite angle, 1e300 rad too: within 0.9. Odd and even exactly; NaN for infinities. */
double elementary_sin(double angle_rad);
double elementary_cos(double angle_rad);

/* Both at the price of one: the same doubles as elementary_sin and elementary_cos. */
struct elementary_sincos elementary_sincos(double angle_rad);

/* The angle less whole turns (of 2 pi, not of its double), from -PI to PI as doubles: every finite
 * angle within 0.6, those already there unchanged. Odd exactly; NaN for infinities. */
double elementary_wrap(double angle_rad);

/* Of 2 pi turns, |turns| <= 2^48, within 0.9: whole, half and quarter turns are exact. */
struct elementary_sincos elementary_sincos_turns(double turns);

/* The angle of (x, y), within 0.6, from -PI to PI as doubles; signed zeros and infinities as C has
 * them. Odd in y exactly. */
double elementary_atan2(double y, double x);

/* Within 0.8; odd exactly; NaN beyond [-1, 1]. */
double elementary_asin(double sine);

/* Of x >= 0; -infinity at 0, NaN below. Within 0.9, and log10 within 0.6: exact where x is a power
 * of ten. */
double elementary_log(double x);
double elementary_log10(double x);

/* Within 0.9, and among subnormal results within 1 of their common unit; 0 and infinity where the
 * result leaves the doubles. */
double elementary_exp(double x);

/* base^exponent for base >= 0 and a finite exponent, NaN otherwise; within 1, correctly rounded for
 * exponents 1, 2 and 1/2, within 1.3 for 3/2. */
double elementary_pow(double base, double exponent);

/* sqrt(x^2 + y^2) without overflow or underflow on the way, within 1.2; exact where a side is 0. */
double elementary_hypot(double x, double y);

/* x 2^exponent, rounded once where it is subnormal: scalbn by a product, which is what it costs as
 * long as the power itself is a normal double. */
static inline double elementary_scaled(double x, int exponent)
{
    if (exponent < -1022 || exponent > 1023)
        return scalbn(x, exponent);
    double power;
    memcpy(&power, &(uint64_t){(uint64_t)(exponent + 1023) << 52}, sizeof power);
    return x * power;
}

/* The lesser and the greater of two numbers, and the first of equal ones: of two zeros that differ
 * in sign fmin and fmax take either. Of a NaN and a number the number. */
static inline double elementary_min(double a, double b)
{
    return b < a || isnan(a) ? b : a;
}

static inline double elementary_max(double a, double b)
{
    return b > a || isnan(a) ? b : a;
}

#endif
