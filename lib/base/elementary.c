#include "base/elementary.h"

#include <float.h>
#include <stdbool.h>

#if FLT_EVAL_METHOD != 0 || defined __FAST_MATH__
#error "every operation must round once, to double, as written: with -ffast-math, or registers \
wider than a double (x87: use SSE2), results would depend on the compiler"
#endif

/* Polynomials are weighted minimax fits (Remez exchange in 60 digits). The first two coefficients
 * are rounded to doubles one after the other, and the later ones fitted to the remainder. The
 * comment at each gives the function, the interval and the largest relative error of the fit. Other
 * constants are the named numbers; of two parts, hi is the rounded number and lo the exact number
 * less hi. */

#define PI_2_HI 0x1.921fb54442d18p+0
#define PI_2_LO 0x1.1a62633145c07p-54
#define PI_4 0x1.921fb54442d18p-1
#define TWO_OVER_PI 0x1.45f306dc9c883p-1

/* Below this, sin x = x and cos x = 1; returning x also keeps the sign of zero. */
#define TINY 0x1p-27

/* Adding and subtracting this rounds to an integer, ties to even; the sum's low bits are that
 * integer. */
#define ROUNDER 0x1.8p52

static const double INFINITE = (double)INFINITY, NO_NUMBER = (double)NAN;

__extension__ typedef unsigned __int128 wide;

/* An unevaluated sum hi + lo; lo is small against hi. */
struct pair {
    double hi, lo;
};

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static double from_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The leading 26 bits: products of two heads are exact, and so is x - head(x). */
static double head(double x)
{
    return from_bits(bits_of(x) & ~UINT64_C(0x7ffffff));
}

/* a + b exactly, where a = 0, |a| >= |b| or a is a multiple of b's last place. */
static struct pair sum_of(double a, double b)
{
    double sum = a + b;
    return (struct pair){sum, (a - sum) + b};
}

/* a b to 2^-104. */
static struct pair product_of(double a, double b)
{
    double product = a * b;
    double a_head = head(a), a_tail = a - a_head;
    double b_head = head(b), b_tail = b - b_head;
    double error = ((a_head * b_head - product) + a_head * b_tail + a_tail * b_head);
    return (struct pair){product, error + a_tail * b_tail};
}

/* An angle as quarter turns and a rest in [-pi/4, pi/4]. */
struct reduced {
    struct pair rest_rad;
    unsigned quarters;
};

/* (sin r - r) / r^3 in r^2, |r| <= pi/4: 2^-57.9. */
static double sine_near_zero(struct pair r)
{
    double z = r.hi * r.hi, zz = z * z;
    double low = -0x1.5555555555548p-3 + 0x1.111111110f730p-7 * z;
    double middle = -0x1.a01a019be9217p-13 + 0x1.71de35552b524p-19 * z;
    double high = -0x1.ae5e4b83e3bf7p-26 + 0x1.5d8b559481342p-33 * z;
    double p = low + zz * (middle + zz * high);
    return r.hi + (r.hi * (z * p) + (r.lo - 0.5 * z * r.lo));
}

/* (cos r - 1 + r^2/2) / r^4 in r^2, |r| <= pi/4: 2^-63.9. */
static double cosine_near_zero(struct pair r)
{
    double z = r.hi * r.hi, zz = z * z;
    double low = 0x1.555555555554bp-5 - 0x1.6c16c16c15015p-10 * z;
    double middle = 0x1.a01a019c8f254p-16 - 0x1.27e4f7f19148dp-22 * z;
    double high = 0x1.1ee9dbcefc054p-29 - 0x1.8fa6848755231p-37 * z;
    double p = low + zz * (middle + zz * high);
    struct pair start = sum_of(1, -0.5 * z);
    return start.hi + (start.lo + (zz * p - r.hi * r.lo));
}

/* Subtracts quarters times pi/2, with pi/2 in three parts of 33 bits and a rest; products of a part
 * with less than 2^20 quarters are exact. The differences are exact too, or sum_of holds because
 * the minuend is a multiple of the subtrahend's last place. */
static struct reduced reduce_near(double angle_rad)
{
    double counted = angle_rad * TWO_OVER_PI + ROUNDER;
    double quarters = counted - ROUNDER;
    double first = angle_rad - quarters * 0x1.921fb544p+0;
    struct pair second = sum_of(first, -(quarters * 0x1.0b4611a6p-34));
    struct pair third = sum_of(second.hi, -(quarters * 0x1.3198a2ep-69));
    double lo = (second.lo + third.lo) - quarters * 0x1.b839a252049c1p-104;
    return (struct reduced){sum_of(third.hi, lo), (unsigned)bits_of(counted)};
}

/* |angle| 2/pi modulo 4, |angle| >= 2^20: sets the whole quarters, returns the rest in units of
 * 2^-128. Of the bits of 2/pi only those matter whose product with the last place of the angle is
 * below 4; 192 of them leave 2^-137, and no double lies closer than 2^-62 to a multiple of pi/2. */
static wide count_quarters(double angle_rad, unsigned *whole)
{
    /* 2/pi in binary, after 64 zeros. */
    static const uint64_t two_over_pi[] = {
        0x0000000000000000, 0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041,
        0xfe5163abdebbc561, 0xb7246e3a424dd2e0, 0x06492eea09d1921c, 0xfe1deb1cb129a73e,
        0xe88235f52ebb4484, 0xe99c7026b45f7e41, 0x3991d639835339f4, 0x9c845f8bbdf9283b,
        0x1ff897ffde05980f, 0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7, 0x4f463f669e5fea2d,
        0x7527bac7ebe5f17b, 0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x5603304600000000,
    };
    uint64_t bits = bits_of(angle_rad);
    uint64_t mantissa = (bits & UINT64_C(0xfffffffffffff)) | UINT64_C(0x10000000000000);
    unsigned begin = (unsigned)(bits >> 52 & 0x7ff) - 1075 - 2 + 64;
    const uint64_t *words = two_over_pi + begin / 64;
    uint64_t window[3];
    for (int i = 0; i < 3; i++) {
        wide two_words = (wide)words[i] << 64 | words[i + 1];
        window[i] = (uint64_t)(two_words << begin % 64 >> 64);
    }
    wide low = (wide)mantissa * window[2];
    wide high = ((wide)(mantissa * window[0]) << 64) + (wide)mantissa * window[1] + (low >> 64);
    *whole = (unsigned)(high >> 126);
    return high << 2 | (uint64_t)low >> 62;
}

/* (pi/2) (hi + lo), |hi| <= 1/2. */
static struct pair quarters_rad(double hi, double lo)
{
    struct pair product = product_of(hi, PI_2_HI);
    return sum_of(product.hi, product.lo + (hi * PI_2_LO + lo * PI_2_HI));
}

static struct reduced reduce_far(double angle_rad)
{
    unsigned whole;
    wide rest = count_quarters(angle_rad, &whole);
    double sign = angle_rad < 0 ? -1 : 1;
    if (rest >> 127) {
        whole++;
        sign = -sign;
        rest = ~rest;
    }
    int shift = __builtin_clzll((uint64_t)(rest >> 64));
    rest <<= shift;
    double hi = scalbn((double)(uint64_t)(rest >> 75), -53 - shift);
    double lo = scalbn((double)((uint64_t)(rest >> 22) & UINT64_C(0x1fffffffffffff)), -106 - shift);
    return (struct reduced){quarters_rad(sign * hi, sign * lo), angle_rad < 0 ? -whole : whole};
}

static struct reduced reduce(double angle_rad)
{
    return fabs(angle_rad) <= 0x1p20 ? reduce_near(angle_rad) : reduce_far(angle_rad);
}

static struct elementary_sincos turn_quarters(struct pair rest_rad, unsigned quarters)
{
    double sine = sine_near_zero(rest_rad), cosine = cosine_near_zero(rest_rad);
    uint64_t swap = -(uint64_t)(quarters & 1);
    uint64_t differ = swap & (bits_of(sine) ^ bits_of(cosine));
    uint64_t sine_sign = (uint64_t)(quarters >> 1 & 1) << 63;
    uint64_t cosine_sign = (uint64_t)((quarters + 1) >> 1 & 1) << 63;
    return (struct elementary_sincos){from_bits(bits_of(sine) ^ differ ^ sine_sign),
                                      from_bits(bits_of(cosine) ^ differ ^ cosine_sign)};
}

struct elementary_sincos elementary_sincos(double angle_rad)
{
    if (!(fabs(angle_rad) < INFINITE))
        return (struct elementary_sincos){NO_NUMBER, NO_NUMBER};
    if (fabs(angle_rad) < TINY)
        return (struct elementary_sincos){angle_rad, 1};
    struct reduced reduced = reduce(angle_rad);
    return turn_quarters(reduced.rest_rad, reduced.quarters);
}

double elementary_sin(double angle_rad)
{
    if (fabs(angle_rad) <= PI_4 && fabs(angle_rad) >= TINY)
        return sine_near_zero((struct pair){angle_rad, 0});
    return elementary_sincos(angle_rad).sin;
}

double elementary_cos(double angle_rad)
{
    if (fabs(angle_rad) <= PI_4)
        return cosine_near_zero((struct pair){angle_rad, 0});
    return elementary_sincos(angle_rad).cos;
}

double elementary_wrap(double angle_rad)
{
    if (fabs(angle_rad) <= 2 * PI_2_HI)
        return angle_rad;
    if (!(fabs(angle_rad) < INFINITE))
        return NO_NUMBER;
    struct reduced reduced = reduce(angle_rad);
    /* 0, 1, 2 or -1 quarters; half a turn back where that is nearer. */
    double quarters = (double)((reduced.quarters + 1) & 3) - 1;
    if (quarters == 2 && reduced.rest_rad.hi > 0)
        quarters = -2;
    struct pair wrapped = sum_of(quarters * PI_2_HI, reduced.rest_rad.hi);
    return wrapped.hi + (wrapped.lo + (quarters * PI_2_LO + reduced.rest_rad.lo));
}

struct elementary_sincos elementary_sincos_turns(double turns)
{
    double counted = 4 * turns + ROUNDER;
    struct pair rest_rad = quarters_rad(4 * turns - (counted - ROUNDER), 0);
    return turn_quarters(rest_rad, (unsigned)bits_of(counted));
}

/* (atan t - t) / t^3 in t^2, |t| <= 1/16: 2^-62.5. */
static double atan_rest(double t)
{
    double z = t * t;
    double low = -0x1.5555555555536p-2 + 0x1.999999996242fp-3 * z;
    double high = -0x1.249248269f1a6p-3 + 0x1.c71878342a011p-4 * z;
    return t * (z * (low + z * z * (high - 0x1.70beaffe8644ep-4 * (z * z))));
}

/* atan(n/d) - atan(c) = atan(t), t = (n - c d) / (d + c n) at most 1/16 in size; c has few bits. */
static struct pair atan_beyond(double n, double d, double c)
{
    double n_head = head(n), d_head = head(d);
    struct pair above = sum_of(n - c * d_head, -(c * (d - d_head)));
    double below = d + c * n;
    double below_head = head(below);
    double below_tail = ((d - below_head) + c * n_head) + c * (n - n_head);
    double inverse = 1 / below;
    double quotient = above.hi * inverse, t = head(quotient);
    double left = ((above.hi - t * below_head) - t * below_tail) + above.lo;
    return (struct pair){t, left * inverse + atan_rest(quotient)};
}

/* For x and y between 2^-500 and 2^500 in size. */
static double angle_of(double y, double x)
{
    /* atan(j/8). */
    static const struct pair eighths[] = {
        {0, 0},
        {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
        {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
        {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
        {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
        {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
        {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
        {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
        {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
    };
    /* By octant: the axis from which the angle is counted, and the sign with which it counts. */
    static const struct pair axes[] = {
        {0, 0}, {PI_2_HI, PI_2_LO}, {2 * PI_2_HI, 2 * PI_2_LO}, {PI_2_HI, PI_2_LO}};
    static const double sides[] = {1, -1, -1, 1};
    double across = fabs(y), along = fabs(x);
    unsigned steep = across > along;
    double n = steep ? along : across, d = steep ? across : along;
    int j = (int)(n / d * 8 + 0.5);
    struct pair rest = atan_beyond(n, d, j * 0.125);
    unsigned octant = steep + (x < 0 ? 2 : 0);
    double side = sides[octant];
    struct pair start = sum_of(axes[octant].hi, side * eighths[j].hi);
    start.lo += axes[octant].lo + side * eighths[j].lo;
    struct pair angle = sum_of(start.hi, side * rest.hi);
    angle.lo += start.lo + side * rest.lo;
    return copysign(angle.hi + angle.lo, y);
}

/* The angle for zeros, infinities, NaN, and sizes whose products would over- or underflow. */
static double extreme_angle(double y, double x)
{
    if (isnan(x) || isnan(y))
        return NO_NUMBER;
    if (isinf(x) || isinf(y)) {
        x = copysign(isinf(x) ? 1 : 0, x);
        y = copysign(isinf(y) ? 1 : 0, y);
    }
    if (y == 0)
        return signbit(x) ? copysign(2 * PI_2_HI, y) : y;
    int x_exponent = -5000, y_exponent;
    if (x != 0)
        frexp(x, &x_exponent);
    frexp(y, &y_exponent);
    if (y_exponent - x_exponent > 70)
        return copysign(PI_2_HI, y);
    if (x_exponent - y_exponent > 70)
        return x < 0 ? copysign(2 * PI_2_HI, y) : y / x;
    return angle_of(scalbn(y, -x_exponent), scalbn(x, -x_exponent));
}

static int has_room(double x)
{
    return fabs(x) >= 0x1p-500 && fabs(x) <= 0x1p500;
}

double elementary_atan2(double y, double x)
{
    return has_room(x) && has_room(y) ? angle_of(y, x) : extreme_angle(y, x);
}

/* (asin x - x) / x in z = x^2 <= 1/4: 2^-59.4. */
static double asin_rest(double z)
{
    double zz = z * z, z4 = zz * zz;
    double a = 0x1.5555555555577p-3 + 0x1.333333332e131p-4 * z;
    double b = 0x1.6db6db7212842p-5 + 0x1.f1c71a94dbe58p-6 * z;
    double c = 0x1.6e8bdee42f953p-6 + 0x1.1c49effcd696cp-6 * z;
    double d = 0x1.ca1f98d4b79dbp-7 + 0x1.75851861d0192p-7 * z;
    double e = 0x1.613f7b3e88bfap-7 + 0x1.e5c21d23569ebp-9 * z;
    double f = 0x1.63ae5813d3a14p-6 - 0x1.581a2c7282da1p-6 * z + 0x1.0b50d195ff05cp-5 * zz;
    return z * ((a + zz * b) + z4 * ((c + zz * d) + z4 * (e + zz * f)));
}

double elementary_asin(double sine)
{
    double size = fabs(sine);
    if (size <= 0.5)
        return sine + sine * asin_rest(sine * sine);
    if (!(size <= 1))
        return NO_NUMBER;
    if (size == 1)
        return copysign(PI_2_HI, sine);
    /* pi/2 - 2 asin sqrt((1 - size)/2). */
    double square = (1 - size) / 2, root = sqrt(square);
    double root_head = head(root);
    double root_tail = (square - root_head * root_head) / (root + root_head);
    struct pair angle = sum_of(PI_2_HI, -2 * root_head);
    angle.lo += PI_2_LO - 2 * (root_tail + root * asin_rest(square));
    return copysign(angle.hi + angle.lo, sine);
}

#define LOG_2_HI 0x1.62e42fefa38p-1 /* a multiple of 2^-42: exact times any exponent */
#define LOG_2_LO 0x1.ef35793c7673p-45

/* x = m 2^k for finite x > 0, m from 11/16 to 22/16. */
static double split_binary(double x, double *k)
{
    int subnormal = x < 0x1p-1022 ? 54 : 0;
    uint64_t bits = bits_of(subnormal ? x * 0x1p54 : x);
    /* Counted from 11/16 2^-1023, so that the difference stays positive. */
    uint64_t exponent = (bits - UINT64_C(0x3fe6000000000000) + (UINT64_C(1023) << 52)) >> 52;
    *k = (double)((int)exponent - 1023 - subnormal);
    return from_bits(bits - ((exponent - 1023) << 52));
}

/* (log((1+s)/(1-s)) - 2s) / s^3 in s^2, |s| <= 1/43: 2^-71.4 of 2s. */
static double log_rest(double s)
{
    double z = s * s;
    double low = 0x1.5555555555555p-1 + 0x1.999999999c83ep-2 * z;
    double high = 0x1.249248e5412c6p-2 + 0x1.c720a9eab088bp-3 * z;
    return s * (z * (low + z * z * (high + 0x1.68242da939e58p-3 * (z * z))));
}

/* log x to 2^-64 for finite x > 0: with c the nearest sixteenth to m and s = (m - c) / (m + c),
 * log x = k log 2 + log c + log((1+s)/(1-s)). */
static struct pair log_of(double x)
{
    /* log(j/16), j = 11 to 22. hi is a multiple of 2^-42, so that its sum with k log 2 is exact. */
    static const struct pair sixteenths[] = {
        {-0x1.7fafa3bd81p-2, -0x1.46fb79bf6d4cbp-44}, {-0x1.269621134ep-2, 0x1.1b61f10522625p-44},
        {-0x1.a93ed3c8aep-3, 0x1.8724350562169p-45},  {-0x1.1178e8227ep-3, -0x1.1ef78ce2d07f2p-45},
        {-0x1.08598b59e4p-4, 0x1.7e5dd7009902cp-46},  {0, 0},
        {0x1.f0a30c0118p-5, -0x1.d599e83368e91p-45},  {0x1.e27076e2bp-4, -0x1.a342c2af0003cp-45},
        {0x1.5ff3070a7ap-3, -0x1.8586f183bebf2p-44},  {0x1.c8ff7c79aap-3, -0x1.7794f689f8434p-45},
        {0x1.1675cababap-2, 0x1.8380e731f55c4p-44},   {0x1.4618bc21c6p-2, -0x1.3d82f484c84ccp-46},
    };
    double k, m = split_binary(x, &k);
    int j = (int)(m * 16 + 0.5);
    double c = j * 0.0625;
    double above = m - c, below = m + c;
    double inverse = 1 / below;
    double below_head = head(below), below_tail = m - (below_head - c);
    double quotient = above * inverse, s = head(quotient);
    double s_tail = ((above - s * below_head) - s * below_tail) * inverse;
    struct pair base = sixteenths[j - 11];
    struct pair sum = sum_of(k * LOG_2_HI + base.hi, 2 * s);
    return sum_of(sum.hi, sum.lo + ((k * LOG_2_LO + base.lo) + (2 * s_tail + log_rest(quotient))));
}

static double log_outside(double x)
{
    if (x == 0)
        return -INFINITE;
    return x > 0 ? x : NO_NUMBER;
}

/* log m = 2 s + s^3 p, with f = m - 1, s = f / (2 + f) and 2 s = f - s f; p as in log_rest, but
 * |s| <= 5/27: 2^-57.7. */
double elementary_log(double x)
{
    if (!(x > 0 && x < INFINITE))
        return log_outside(x);
    double k, f = split_binary(x, &k) - 1;
    double s = f / (2 + f);
    double z = s * s, zz = z * z;
    double low = 0x1.555555555560ap-1 + 0x1.999999995828bp-2 * z;
    double middle = 0x1.24924964a8817p-2 + 0x1.c71c36592b2dbp-3 * z;
    double high = 0x1.746bcadb58c76p-3 + 0x1.391681fb99197p-3 * z + 0x1.3456470a3f859p-3 * zz;
    double p = low + zz * (middle + zz * high);
    struct pair sum = sum_of(k * LOG_2_HI, f);
    return sum.hi + (sum.lo + (k * LOG_2_LO - s * (f - z * p)));
}

double elementary_log10(double x)
{
    if (!(x > 0 && x < INFINITE))
        return log_outside(x);
    const struct pair per_log_10 = {0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57};
    struct pair log = log_of(x);
    struct pair product = product_of(log.hi, per_log_10.hi);
    return product.hi + (product.lo + (log.hi * per_log_10.lo + log.lo * per_log_10.hi));
}

/* (exp r - 1 - r) / r^2, |r| <= log(2)/2: 2^-63.5. */
static double exp_rest(double r)
{
    double rr = r * r, r4 = rr * rr;
    double a = 0x1p-1 + 0x1.555555555555ap-3 * r;
    double b = 0x1.555555555555dp-5 + 0x1.111111110f32bp-7 * r;
    double c = 0x1.6c16c16c17f08p-10 + 0x1.a01a01b0f6a7p-13 * r;
    double d = 0x1.a01a018d640efp-16 + 0x1.71ddf60d71c61p-19 * r;
    double e = 0x1.27e5298789db9p-22 + 0x1.af6248f5f4435p-26 * r + 0x1.1ee1d606ab312p-29 * rr;
    return rr * ((a + rr * b) + r4 * ((c + rr * d) + r4 * e));
}

/* exp(hi + lo). */
static double exp_of(double hi, double lo)
{
    if (hi > 709.79)
        return INFINITE;
    if (hi < -745.2)
        return 0;
    double counted = hi * 0x1.71547652b82fep+0 + ROUNDER;
    double k = counted - ROUNDER;
    double first = hi - k * LOG_2_HI;
    struct pair r = sum_of(first, lo - k * LOG_2_LO);
    double value = 1 + (r.hi + (exp_rest(r.hi) + (r.lo + r.hi * r.lo)));
    return elementary_scaled(value, (int)k);
}

double elementary_exp(double x)
{
    return isnan(x) ? x : exp_of(x, 0);
}

double elementary_pow(double base, double exponent)
{
    if (exponent == 2)
        return base * base;
    if (exponent == 0.5)
        return sqrt(base);
    if (exponent == 1.5)
        return base * sqrt(base);
    if (exponent == 1 || exponent == 0)
        return exponent == 1 ? base : 1;
    if (!(base >= 0 && isfinite(exponent)))
        return NO_NUMBER;
    if (base == 0 || isinf(base))
        return (base == 0) == (exponent > 0) ? 0 : INFINITE;
    static const struct pair log_10 = {0x1.26bb1bbb55516p+1, -0x1.f48ad494ea4p-53}; /* log_of(10) */
    struct pair log = base == 10 ? log_10 : log_of(base);
    struct pair product = product_of(exponent, log.hi);
    return exp_of(product.hi, product.lo + exponent * log.lo);
}

double elementary_hypot(double x, double y)
{
    bool steep = fabs(x) < fabs(y);
    double longer = fabs(steep ? y : x), shorter = fabs(steep ? x : y);
    if (longer >= 0x1p-400 && longer <= 0x1p500)
        return sqrt(longer * longer + shorter * shorter);
    if (isinf(x) || isinf(y))
        return INFINITE;
    if (longer == 0 || isnan(longer) || isnan(shorter))
        return longer + shorter;
    int exponent;
    longer = frexp(longer, &exponent);
    shorter = scalbn(shorter, -exponent);
    return scalbn(sqrt(longer * longer + shorter * shorter), exponent);
}
