/* Times of the elementary functions and of libm's: ROUNDS lines per function of NAME, OURS_NS and
 * LIBM_NS between tabs, per call, all functions in turn each round. scripts/bench --functions takes
 * the medians. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/elementary.h"
#include "base/random.h"
#include "base/units.h"
#include "clock.h"
#include "support/sample.h"

enum { CALLS = 4096, SWEEPS = 25 };

/* glint's function and libm's, of x or of (x, y). */
#define ONE(name)                                                                                  \
    static double our_##name(double x, double y)                                                   \
    {                                                                                              \
        (void)y;                                                                                   \
        return elementary_##name(x);                                                               \
    }                                                                                              \
    static double libm_##name(double x, double y)                                                  \
    {                                                                                              \
        (void)y;                                                                                   \
        return name(x);                                                                            \
    }

ONE(sin)
ONE(cos)
ONE(asin)
ONE(log)
ONE(log10)
ONE(exp)

static double our_pair(double x, double y)
{
    (void)y;
    struct elementary_sincos of = elementary_sincos(x);
    return of.sin + of.cos;
}

static double libm_pair(double x, double y)
{
    (void)y;
    return sin(x) + cos(x);
}

static double our_turns(double x, double y)
{
    (void)y;
    struct elementary_sincos of = elementary_sincos_turns(x);
    return of.sin + of.cos;
}

static double libm_turns(double x, double y)
{
    return libm_pair(2 * PI * x, y);
}

/* Four Gaussian draws, both from the same four uniform ones; y is the index. */
static double our_gaussians(double x, double y)
{
    double of[4];
    random_gaussian(&(struct random_address){.seed = 1, .frame = (uint64_t)x}, RANDOM_POINTERS,
                    (uint32_t)y, of);
    return of[0] + of[1] + of[2] + of[3];
}

static double libm_gaussians(double x, double y)
{
    double of[4], sum = 0;
    random_uniform(&(struct random_address){.seed = 1, .frame = (uint64_t)x}, RANDOM_POINTERS,
                   (uint32_t)y, of);
    for (int i = 0; i < 4; i += 2)
        sum += sqrt(-2 * log(of[i])) * (cos(2 * PI * of[i + 1]) + sin(2 * PI * of[i + 1]));
    return sum;
}

static const struct {
    const char *name;
    double (*ours)(double x, double y), (*libm)(double x, double y);
    double x_low, x_high, y_low, y_high;
} functions[] = {
    {"sin", our_sin, libm_sin, -PI, PI, 0, 0},
    {"cos", our_cos, libm_cos, -PI, PI, 0, 0},
    {"sin+cos", our_pair, libm_pair, -PI, PI, 0, 0},
    {"sin+cos, far", our_pair, libm_pair, 1e6, 1e9, 0, 0},
    {"sin+cos of turns", our_turns, libm_turns, 0, 1, 0, 0},
    {"atan2", elementary_atan2, atan2, -200, 200, -200, 200},
    {"asin", our_asin, libm_asin, -1, 1, 0, 0},
    {"log", our_log, libm_log, 1e-3, 1e3, 0, 0},
    {"log10", our_log10, libm_log10, 1e-3, 1e3, 0, 0},
    {"exp", our_exp, libm_exp, -20, 20, 0, 0},
    {"pow", elementary_pow, pow, 1e-3, 1e3, -4, 4},
    {"hypot", elementary_hypot, hypot, -200, 200, -200, 200},
    {"4 Gaussian draws", our_gaussians, libm_gaussians, 0, 1e6, 0, 100},
};

static double ns_per_call(double (*function)(double x, double y), const double *x, const double *y)
{
    volatile double sink;
    double sum = 0, begin_ns = cpu_ns();
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (int i = 0; i < CALLS; i++)
            sum += function(x[i], y[i]);
    sink = sum;
    (void)sink;
    return (cpu_ns() - begin_ns) / (SWEEPS * CALLS);
}

int main(int count, char **words)
{
    static double x[CALLS], y[CALLS];
    int rounds = count > 1 ? atoi(words[1]) : 5;
    for (int round = 0; round < rounds; round++)
        for (size_t f = 0; f < sizeof functions / sizeof functions[0]; f++) {
            uint64_t random = f;
            for (int i = 0; i < CALLS; i++) {
                x[i] = sample_between(&random, functions[f].x_low, functions[f].x_high);
                y[i] = sample_between(&random, functions[f].y_low, functions[f].y_high);
            }
            double ours_ns = ns_per_call(functions[f].ours, x, y);
            double libm_ns = ns_per_call(functions[f].libm, x, y);
            printf("%s\t%.3f\t%.3f\n", functions[f].name, ours_ns, libm_ns);
        }
    return 0;
}
