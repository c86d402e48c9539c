/* 30 000 points a row, or as many as CASES says; then the largest error of each row is printed. */
#include "check.h"

#include <float.h>

#include <mpfr.h>

#include "base/elementary.h"
#include "base/units.h"
#include "sample.h"
#include "ulp.h"

#define POINTS 30000
#define HALF_PI_LONG 1.57079632679489661923132169163975144L

struct point {
    double x, y;
};

/* A function of one argument or of two, and its exact value. */
struct function {
    double (*of_one)(double x);
    double (*of_two)(double x, double y);
    int (*exact_of_one)(mpfr_t result, const mpfr_t x, mpfr_rnd_t round);
    int (*exact_of_two)(mpfr_t result, const mpfr_t x, const mpfr_t y, mpfr_rnd_t round);
};

struct trial {
    const char *what;
    const struct function *function;
    struct point (*draw)(uint64_t *random);
    double bound_ulp;
};

static double sin_of_turns(double turns)
{
    return elementary_sincos_turns(turns).sin;
}

static double cos_of_turns(double turns)
{
    return elementary_sincos_turns(turns).cos;
}

static double atan2_of_place(double x, double y)
{
    return elementary_atan2(y, x);
}

/* 1400 bits hold any double in full and 160 bits of the result beyond it. */
static int exact_wrap(mpfr_t result, const mpfr_t x, mpfr_rnd_t round)
{
    MPFR_DECL_INIT(turn, 1400);
    mpfr_const_pi(turn, MPFR_RNDN);
    mpfr_mul_2ui(turn, turn, 1, MPFR_RNDN);
    int rounded = mpfr_remainder(result, x, turn, round);
    return rounded;
}

static int exact_sin_of_turns(mpfr_t result, const mpfr_t turns, mpfr_rnd_t round)
{
    return mpfr_sinu(result, turns, 1, round);
}

static int exact_cos_of_turns(mpfr_t result, const mpfr_t turns, mpfr_rnd_t round)
{
    return mpfr_cosu(result, turns, 1, round);
}

static int exact_atan2(mpfr_t result, const mpfr_t x, const mpfr_t y, mpfr_rnd_t round)
{
    return mpfr_atan2(result, y, x, round);
}

static const struct function of_sin = {.of_one = elementary_sin, .exact_of_one = mpfr_sin},
                             of_cos = {.of_one = elementary_cos, .exact_of_one = mpfr_cos},
                             of_wrap = {.of_one = elementary_wrap, .exact_of_one = exact_wrap},
                             of_turn_sin = {.of_one = sin_of_turns,
                                            .exact_of_one = exact_sin_of_turns},
                             of_turn_cos = {.of_one = cos_of_turns,
                                            .exact_of_one = exact_cos_of_turns},
                             of_atan2 = {.of_two = atan2_of_place, .exact_of_two = exact_atan2},
                             of_asin = {.of_one = elementary_asin, .exact_of_one = mpfr_asin},
                             of_log = {.of_one = elementary_log, .exact_of_one = mpfr_log},
                             of_log10 = {.of_one = elementary_log10, .exact_of_one = mpfr_log10},
                             of_exp = {.of_one = elementary_exp, .exact_of_one = mpfr_exp},
                             of_pow = {.of_two = elementary_pow, .exact_of_two = mpfr_pow},
                             of_hypot = {.of_two = elementary_hypot, .exact_of_two = mpfr_hypot};

/* The error of a function at a point; 0 where the exact value is beyond the doubles. */
static double error_at(const struct function *function, struct point at)
{
    MPFR_DECL_INIT(x, 160);
    MPFR_DECL_INIT(y, 160);
    MPFR_DECL_INIT(exact, 160);
    mpfr_set_d(x, at.x, MPFR_RNDN);
    mpfr_set_d(y, at.y, MPFR_RNDN);
    double ours;
    if (function->of_two != NULL) {
        ours = function->of_two(at.x, at.y);
        function->exact_of_two(exact, x, y, MPFR_RNDN);
    } else {
        ours = function->of_one(at.x);
        function->exact_of_one(exact, x, MPFR_RNDN);
    }
    bool finite = mpfr_cmp_d(exact, DBL_MAX) <= 0;
    double ulp = finite ? error_ulp(ours, exact) : 0;
    return ulp;
}

static double either_sign(uint64_t *random, double size)
{
    return sample_between(random, -1, 1) < 0 ? -size : size;
}

/* From 2^low to 2^high, all 53 bits drawn. */
static double between_powers(uint64_t *random, double low, double high)
{
    double exponent = floor(sample_between(random, low, high));
    double mantissa = sample_between(random, 1, 2) + sample_between(random, 0, 0x1p-48);
    return ldexp(mantissa, (int)exponent);
}

/* A double at most a few steps away. */
static double near(uint64_t *random, double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    bits += (uint64_t)sample_between(random, 0, 7) - 3;
    memcpy(&x, &bits, sizeof bits);
    return x;
}

static struct point angle_of_any_size(uint64_t *random)
{
    return (struct point){either_sign(random, between_powers(random, -1074, 1024)), 0};
}

static struct point angle_of_the_chain(uint64_t *random)
{
    return (struct point){either_sign(random, between_powers(random, -40, 20)), 0};
}

static struct point angle_of_one_turn(uint64_t *random)
{
    return (struct point){sample_between(random, -2 * PI, 2 * PI), 0};
}

/* Near multiples of pi/4: zeros of sine and cosine, and seams of the reduction. */
static struct point angle_at_a_seam(uint64_t *random)
{
    double eighths = floor(between_powers(random, 0, 21));
    double angle_rad = (double)(HALF_PI_LONG / 2 * (long double)eighths);
    return (struct point){either_sign(random, near(random, angle_rad)), 0};
}

static struct point far_angle_at_a_zero(uint64_t *random)
{
    double quarters = floor(between_powers(random, 19, 63));
    double angle_rad = (double)(HALF_PI_LONG * (long double)quarters);
    return (struct point){either_sign(random, near(random, angle_rad)), 0};
}

static struct point turns_of_any_size(uint64_t *random)
{
    return (struct point){either_sign(random, between_powers(random, -1000, 48)), 0};
}

static struct point uniform_draw(uint64_t *random)
{
    return (struct point){floor(sample_between(random, 0, 0x1p52)) * 0x1p-52 + 0x1p-53, 0};
}

static struct point turns_at_a_seam(uint64_t *random)
{
    double eighths = floor(sample_between(random, 1, 17));
    double aside = either_sign(random, between_powers(random, -53, -20));
    return (struct point){eighths / 8 + aside, 0};
}

static struct point place_of_any_size(uint64_t *random)
{
    double x = either_sign(random, between_powers(random, -1074, 1024));
    double y = fabs(x) * between_powers(random, -60, 60);
    return (struct point){x, either_sign(random, fmin(fmax(y, 0x1p-1074), DBL_MAX))};
}

static struct point place_on_a_map(uint64_t *random)
{
    return (struct point){sample_between(random, -200, 200), sample_between(random, -200, 200)};
}

/* Directions close to a multiple of one eighth, or where the nearest eighth changes. */
static struct point place_at_a_seam(uint64_t *random)
{
    double x = either_sign(random, between_powers(random, -10, 10));
    double ratio = floor(sample_between(random, 0, 17)) / 16;
    double aside = either_sign(random, between_powers(random, -60, -4));
    double y = either_sign(random, near(random, fabs(x * (ratio + aside))));
    bool steep = sample_between(random, -1, 1) < 0;
    return (struct point){steep ? y : x, steep ? x : y};
}

static struct point sine_of_any_size(uint64_t *random)
{
    return (struct point){either_sign(random, between_powers(random, -1074, 0)), 0};
}

static struct point sine_near_the_side(uint64_t *random)
{
    return (struct point){either_sign(random, 1 - between_powers(random, -53, -1)), 0};
}

static struct point sine_around_a_half(uint64_t *random)
{
    double aside = either_sign(random, between_powers(random, -53, -2));
    return (struct point){either_sign(random, 0.5 + aside), 0};
}

static struct point any_positive(uint64_t *random)
{
    return (struct point){between_powers(random, -1074, 1024), 0};
}

static struct point around_one(uint64_t *random)
{
    return (struct point){1 + either_sign(random, between_powers(random, -53, -1)), 0};
}

/* Near places where the nearest sixteenth or the exponent changes. */
static struct point at_a_sixteenth(uint64_t *random)
{
    double sixteenths = floor(sample_between(random, 20, 46)) / 32;
    double aside = either_sign(random, between_powers(random, -53, -6));
    return (struct point){ldexp(sixteenths + aside, (int)floor(sample_between(random, -3, 3))), 0};
}

static struct point near_a_power_of_ten(uint64_t *random)
{
    return (struct point){near(random, pow(10, floor(sample_between(random, -300, 300)))), 0};
}

static struct point exponent_of_any_size(uint64_t *random)
{
    return (struct point){either_sign(random, between_powers(random, -1074, 9)), 0};
}

static struct point exponent_of_a_normal(uint64_t *random)
{
    return (struct point){sample_between(random, -708.39, 709.78), 0};
}

static struct point exponent_of_a_subnormal(uint64_t *random)
{
    return (struct point){sample_between(random, -745.1, -708.4), 0};
}

/* Near odd multiples of log(2)/2, where k changes. */
static struct point exponent_at_a_seam(uint64_t *random)
{
    double halves = floor(sample_between(random, -1021, 1023)) + 0.5;
    return (struct point){near(random, halves * 0.69314718055994531), 0};
}

static struct point decibels(uint64_t *random)
{
    return (struct point){10, sample_between(random, -300, 300) / 20};
}

static struct point range_law(uint64_t *random)
{
    static const double exponents[] = {0.5, 1, 2, 2.5, 3, 4, 1 / 1.5, 1 / 3.0};
    double exponent = exponents[(int)sample_between(random, 0, 8)];
    return (struct point){between_powers(random, -30, 30), exponent};
}

static struct point three_halves(uint64_t *random)
{
    return (struct point){between_powers(random, -30, 30), 1.5};
}

/* Results up to the largest doubles. */
static struct point any_normal_power(uint64_t *random)
{
    double base = between_powers(random, -1022, 1024);
    return (struct point){base, sample_between(random, -708.3, 709.7) / log(base)};
}

static struct point power_of_about_one(uint64_t *random)
{
    double base = around_one(random).x;
    return (struct point){base, sample_between(random, -708.3, 709.7) / log(base)};
}

static const struct trial trials[] = {
    {"sin, any size", &of_sin, angle_of_any_size, 0.9},
    {"sin, to 2^20", &of_sin, angle_of_the_chain, 0.9},
    {"sin, one turn", &of_sin, angle_of_one_turn, 0.9},
    {"sin, seams to 2^20", &of_sin, angle_at_a_seam, 0.9},
    {"sin, zeros beyond", &of_sin, far_angle_at_a_zero, 0.9},
    {"cos, any size", &of_cos, angle_of_any_size, 0.9},
    {"cos, to 2^20", &of_cos, angle_of_the_chain, 0.9},
    {"cos, one turn", &of_cos, angle_of_one_turn, 0.9},
    {"cos, seams to 2^20", &of_cos, angle_at_a_seam, 0.9},
    {"cos, zeros beyond", &of_cos, far_angle_at_a_zero, 0.9},
    {"wrap, any size", &of_wrap, angle_of_any_size, 0.51},
    {"wrap, to 2^20", &of_wrap, angle_of_the_chain, 0.51},
    {"wrap, seams to 2^20", &of_wrap, angle_at_a_seam, 0.51},
    {"wrap, zeros beyond", &of_wrap, far_angle_at_a_zero, 0.51},
    {"sin of turns, any size", &of_turn_sin, turns_of_any_size, 0.9},
    {"sin of turns, draws", &of_turn_sin, uniform_draw, 0.9},
    {"sin of turns, seams", &of_turn_sin, turns_at_a_seam, 0.9},
    {"cos of turns, any size", &of_turn_cos, turns_of_any_size, 0.9},
    {"cos of turns, draws", &of_turn_cos, uniform_draw, 0.9},
    {"cos of turns, seams", &of_turn_cos, turns_at_a_seam, 0.9},
    {"atan2, any size", &of_atan2, place_of_any_size, 0.6},
    {"atan2, on a map", &of_atan2, place_on_a_map, 0.6},
    {"atan2, seams", &of_atan2, place_at_a_seam, 0.6},
    {"asin, any size", &of_asin, sine_of_any_size, 0.8},
    {"asin, near 1", &of_asin, sine_near_the_side, 0.8},
    {"asin, around 1/2", &of_asin, sine_around_a_half, 0.8},
    {"log, any size", &of_log, any_positive, 0.9},
    {"log, around 1", &of_log, around_one, 0.9},
    {"log, seams", &of_log, at_a_sixteenth, 0.9},
    {"log, draws", &of_log, uniform_draw, 0.9},
    {"log10, any size", &of_log10, any_positive, 0.6},
    {"log10, around 1", &of_log10, around_one, 0.6},
    {"log10, seams", &of_log10, at_a_sixteenth, 0.6},
    {"log10, powers of ten", &of_log10, near_a_power_of_ten, 0.6},
    {"exp, any size", &of_exp, exponent_of_any_size, 0.9},
    {"exp, normal", &of_exp, exponent_of_a_normal, 0.9},
    {"exp, subnormal", &of_exp, exponent_of_a_subnormal, 1},
    {"exp, seams", &of_exp, exponent_at_a_seam, 0.9},
    {"pow, decibels", &of_pow, decibels, 1},
    {"pow, range laws", &of_pow, range_law, 1},
    {"pow, exponent 3/2", &of_pow, three_halves, 1.3},
    {"pow, any normal result", &of_pow, any_normal_power, 1},
    {"pow, base about 1", &of_pow, power_of_about_one, 1},
    {"hypot, any size", &of_hypot, place_of_any_size, 1.2},
    {"hypot, on a map", &of_hypot, place_on_a_map, 1.2},
};

TEST(every_result_is_within_its_bound)
{
    int points = (int)check_cases(POINTS), faults = 0;
    for (size_t i = 0; i < COUNT(trials); i++) {
        uint64_t random = i;
        double worst_ulp = 0;
        struct point worst = {0, 0};
        for (int k = 0; k < points; k++) {
            struct point at = trials[i].draw(&random);
            double ulp = error_at(trials[i].function, at);
            if (!(ulp <= worst_ulp)) {
                worst_ulp = ulp;
                worst = at;
            }
        }
        if (points > POINTS)
            print_message("%-24s %.4f ulp at %a %a\n", trials[i].what, worst_ulp, worst.x, worst.y);
        if (worst_ulp <= trials[i].bound_ulp)
            continue;
        print_error("%s: %.4f ulp at %a %a\n", trials[i].what, worst_ulp, worst.x, worst.y);
        faults++;
    }
    assert_int_equal(faults, 0);
    mpfr_free_cache();
}

static void assert_same_bits(double actual, double expected)
{
    assert_true(memcmp(&actual, &expected, sizeof actual) == 0);
}

TEST(mirrored_arguments_give_mirrored_bits)
{
    uint64_t random = 1;
    for (int i = 0; i < 100000; i++) {
        double x = (i % 2 ? angle_of_the_chain(&random) : angle_of_any_size(&random)).x;
        assert_same_bits(elementary_sin(-x), -elementary_sin(x));
        assert_same_bits(elementary_cos(-x), elementary_cos(x));
        assert_same_bits(elementary_wrap(-x), -elementary_wrap(x));
        double turns = turns_of_any_size(&random).x;
        assert_close(elementary_sincos_turns(-turns).sin, -elementary_sincos_turns(turns).sin, 0);
        assert_close(elementary_sincos_turns(-turns).cos, elementary_sincos_turns(turns).cos, 0);
        double sine = sine_of_any_size(&random).x;
        assert_same_bits(elementary_asin(-sine), -elementary_asin(sine));
        struct point at = place_of_any_size(&random);
        assert_same_bits(elementary_atan2(-at.y, at.x), -elementary_atan2(at.y, at.x));
        assert_same_bits(elementary_hypot(at.y, -at.x), elementary_hypot(at.x, at.y));
    }
}

TEST(sine_and_cosine_together_are_each_alone)
{
    uint64_t random = 2;
    for (int i = 0; i < 100000; i++) {
        double x = (i % 2 ? angle_at_a_seam(&random) : angle_of_any_size(&random)).x;
        struct elementary_sincos both = elementary_sincos(x);
        assert_same_bits(both.sin, elementary_sin(x));
        assert_same_bits(both.cos, elementary_cos(x));
    }
}

/* Neighbouring doubles, and pairs farther apart, also at the seams of the pieces. A function that
 * rises may fall by the rounding of two results, no more. */
TEST(rising_functions_do_not_fall)
{
    uint64_t random = 3;
    for (int i = 0; i < 200000; i++) {
        double x = (i % 2 ? at_a_sixteenth(&random) : around_one(&random)).x;
        double next = x * (1 + 4 * DBL_EPSILON);
        assert_true(elementary_log(next) >= elementary_log(x));
        assert_true(elementary_log10(next) >= elementary_log10(x));
        double exponent = exponent_at_a_seam(&random).x;
        assert_true(elementary_exp(exponent + 4 * DBL_EPSILON * fabs(exponent) + DBL_EPSILON) >=
                    elementary_exp(exponent));
        double sine = fmin(sine_around_a_half(&random).x, 1 - 8 * DBL_EPSILON);
        assert_true(elementary_asin(sine + 4 * DBL_EPSILON) >= elementary_asin(sine));
    }
}

/* The double nearest to a multiple of pi/2, 2^-60.9 away. */
TEST(the_worst_angle_is_reduced)
{
    assert_near(elementary_cos(0x1.6ac5b262ca1ffp+849), -4.68716592425462761112e-19, 2e-16);
    assert_close(fabs(elementary_sin(0x1.6ac5b262ca1ffp+849)), 1, 0);
    assert_near(elementary_cos(1.5707963267948966), 6.123233995736766e-17, 2e-16);
    assert_near(elementary_sin(3.1415926535897931), 1.2246467991473532e-16, 2e-16);
}

TEST(special_angles_are_exact)
{
    assert_same_bits(elementary_sin(0), 0);
    assert_same_bits(elementary_sin(-0.0), -0.0);
    assert_same_bits(elementary_cos(-0.0), 1);
    assert_same_bits(elementary_sin(5e-324), 5e-324);
    assert_true(isnan(elementary_sin((double)INFINITY)) &&
                isnan(elementary_cos(-(double)INFINITY)));
    assert_true(isnan(elementary_sin((double)NAN)) && isnan(elementary_cos((double)NAN)));
    static const struct {
        double turns, sin, cos;
    } cases[] = {
        {0, 0, 1}, {0.25, 1, 0},   {0.5, 0, -1},     {0.75, -1, 0},
        {1, 0, 1}, {-0.25, -1, 0}, {12345.25, 1, 0},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct elementary_sincos turned = elementary_sincos_turns(cases[i].turns);
        assert_close(turned.sin, cases[i].sin, 0);
        assert_close(turned.cos, cases[i].cos, 0);
    }
}

/* As C11 F.10 has them. */
TEST(special_places_have_their_angle)
{
    const double inf = (double)INFINITY;
    const struct {
        double y, x, angle_rad;
    } cases[] = {
        {0, 1, 0},
        {-0.0, 1, -0.0},
        {0, -1, PI},
        {-0.0, -1, -PI},
        {0, 0.0, 0},
        {-0.0, 0.0, -0.0},
        {0, -0.0, PI},
        {-0.0, -0.0, -PI},
        {1, 0.0, PI / 2},
        {-1, -0.0, -PI / 2},
        {1, 1, PI / 4},
        {-1, -1, -3 * PI / 4},
        {1, inf, 0},
        {-1, inf, -0.0},
        {1, -inf, PI},
        {-1, -inf, -PI},
        {inf, 1, PI / 2},
        {-inf, -1, -PI / 2},
        {inf, inf, PI / 4},
        {-inf, -inf, -3 * PI / 4},
        {1e300, 1e-300, PI / 2},
        {1e-300, -1e300, PI},
        {5e-324, 1e300, 0},
        {5e-324, 5e-324, PI / 4},
        {1e308, -1e308, 3 * PI / 4},
        {5e-324, 1, 5e-324},
    };
    for (size_t i = 0; i < COUNT(cases); i++)
        assert_same_bits(elementary_atan2(cases[i].y, cases[i].x), cases[i].angle_rad);
    assert_true(isnan(elementary_atan2((double)NAN, 1)) && isnan(elementary_atan2(1, (double)NAN)));
    assert_same_bits(elementary_asin(1), PI / 2);
    assert_same_bits(elementary_asin(-1), -PI / 2);
    assert_same_bits(elementary_asin(-0.0), -0.0);
    assert_true(isnan(elementary_asin(1 + DBL_EPSILON)) && isnan(elementary_asin((double)NAN)));
}

TEST(special_logarithms_and_powers_are_exact)
{
    const double inf = (double)INFINITY;
    assert_same_bits(elementary_log(1), 0);
    assert_same_bits(elementary_log(0), -inf);
    assert_same_bits(elementary_log10(inf), inf);
    assert_true(isnan(elementary_log(-1)) && isnan(elementary_log10((double)NAN)));
    for (int i = 0; i <= 22; i++)
        assert_same_bits(elementary_log10(pow(10, i)), i);
    assert_same_bits(elementary_exp(0), 1);
    assert_same_bits(elementary_exp(-0.0), 1);
    assert_same_bits(elementary_exp(710), inf);
    assert_same_bits(elementary_exp(-746), 0);
    assert_same_bits(elementary_exp(inf), inf);
    assert_same_bits(elementary_exp(-inf), 0);
    assert_true(isnan(elementary_exp((double)NAN)));
    for (int i = -300; i <= 300; i++)
        assert_same_bits(elementary_pow(2, i), ldexp(1, i));
    assert_same_bits(elementary_pow(10, 0), 1);
    assert_same_bits(elementary_pow(0, 0.7), 0);
    assert_same_bits(elementary_pow(0, -0.7), inf);
    assert_same_bits(elementary_pow(inf, 0.7), inf);
    assert_same_bits(elementary_pow(inf, -0.7), 0);
    assert_same_bits(elementary_pow(1e300, 1.7), inf);
    assert_same_bits(elementary_pow(1e-300, 1.7), 0);
    assert_same_bits(elementary_pow(1 + DBL_EPSILON, 1e300), inf);
    assert_true(isnan(elementary_pow(1, inf)) && isnan(elementary_pow(2, (double)NAN)));
    assert_true(isnan(elementary_pow(-2, 0.7)) && isnan(elementary_pow((double)NAN, 0.7)));
}

TEST(special_hypotenuses_are_exact)
{
    const double inf = (double)INFINITY;
    assert_same_bits(elementary_hypot(3, -4), 5);
    assert_same_bits(elementary_hypot(3e300, 4e300), 5e300);
    assert_same_bits(elementary_hypot(3 * 0x1p-1070, 4 * 0x1p-1070), 5 * 0x1p-1070);
    assert_same_bits(elementary_hypot(0, -0.0), 0);
    assert_same_bits(elementary_hypot(-inf, 1), inf);
    assert_same_bits(elementary_hypot(DBL_MAX, DBL_MAX), inf);
    assert_true(isnan(elementary_hypot((double)NAN, 1)) && isnan(elementary_hypot(0, (double)NAN)));
    assert_same_bits(elementary_hypot((double)NAN, inf), inf);
    uint64_t random = 4;
    for (int i = 0; i < 100000; i++) {
        double x = angle_of_any_size(&random).x;
        assert_same_bits(elementary_hypot(x, 0), fabs(x));
        assert_same_bits(elementary_hypot(0, x), fabs(x));
    }
}

TEST(scaling_rounds_as_scalbn_does)
{
    uint64_t random = 9;
    for (int i = 0; i < 300000; i++) {
        int size = (int)sample_between(&random, -1100, 1000);
        int exponent = (int)sample_between(&random, -2200, 2200);
        double x = scalbn(sample_between(&random, -2, 2), size);
        assert_true(elementary_scaled(x, exponent) == scalbn(x, exponent));
    }
    for (int exponent = -1080; exponent <= 1080; exponent++)
        assert_true(elementary_scaled(1, exponent) == scalbn(1, exponent));
}

/* fmin and fmax may take either of two zeros, and compilers do. */
TEST(the_lesser_and_the_greater_of_equal_numbers_is_the_first)
{
    static const double pairs[][2] = {{0.0, -0.0}, {-0.0, 0.0}};
    for (size_t i = 0; i < 2; i++) {
        double least = elementary_min(pairs[i][0], pairs[i][1]);
        double most = elementary_max(pairs[i][0], pairs[i][1]);
        assert_true(signbit(least) == signbit(pairs[i][0]));
        assert_true(signbit(most) == signbit(pairs[i][0]));
    }
    assert_true(elementary_min(1, 2) == 1 && elementary_min(2, 1) == 1);
    assert_true(elementary_max(1, 2) == 2 && elementary_max(2, 1) == 2);
    assert_true(elementary_min((double)NAN, 1) == 1 && elementary_min(1, (double)NAN) == 1);
    assert_true(elementary_max((double)NAN, 1) == 1 && elementary_max(1, (double)NAN) == 1);
    assert_true(isnan(elementary_min((double)NAN, (double)NAN)));
}
