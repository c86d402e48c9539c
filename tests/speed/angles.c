/* Time and error of inverting the sensing ratio by a table instead of by its closed form: ROUNDS
 * lines per way with ENTRIES (0: the closed form), NS per call, MEAN and GREATEST error in radians,
 * between tabs, all ways in turn each round. tests/tools/accuracy-cost takes the medians.
 *
 * The table is the paper's way (equation 7): azimuths at even steps of the ratio (|delta| - |sum|)
 * / (|delta| + |sum|), straight between them. Echoes are even over 80 degrees to either side. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/units.h"
#include "clock.h"
#include "radar/monopulse.h"
#include "support/sample.h"

enum { CALLS = 4096, SWEEPS = 25, MOST_ENTRIES = 65536 };

static const struct antenna dipoles = {.pattern = ANTENNA_DIPOLE_PAIR};

struct inverse {
    size_t entries; /* 0: the closed form */
    double azimuth_rad[MOST_ENTRIES];
};

/* The azimuth of a ratio by the closed form, from sum 1 - ratio and delta 1 + ratio. */
static void inverse_make(struct inverse *inverse, size_t entries)
{
    inverse->entries = entries;
    for (size_t i = 0; i < entries; i++) {
        double part = 2 * (double)i / (double)(entries - 1);
        inverse->azimuth_rad[i] = antenna_azimuth_rad(&dipoles, part, 2 - part);
    }
}

static double by_table(const struct inverse *inverse, double delta, double sum)
{
    double size = fabs(delta), part = size / (size + sum) * (double)(inverse->entries - 1);
    size_t i = (size_t)part;
    if (i > inverse->entries - 2)
        i = inverse->entries - 2;
    double low = inverse->azimuth_rad[i], high = inverse->azimuth_rad[i + 1];
    return copysign(low + (part - (double)i) * (high - low), delta);
}

static double azimuth_rad(const struct inverse *inverse, double delta, double sum)
{
    return inverse->entries == 0 ? antenna_azimuth_rad(&dipoles, delta, sum)
                                 : by_table(inverse, delta, sum);
}

static double ns_per_call(const struct inverse *inverse, const double *delta, const double *sum)
{
    volatile double sink;
    double total = 0, begin_ns = cpu_ns();
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (int i = 0; i < CALLS; i++)
            total += azimuth_rad(inverse, delta[i], sum[i]);
    sink = total;
    (void)sink;
    return (cpu_ns() - begin_ns) / (SWEEPS * CALLS);
}

int main(int count, char **words)
{
    static double truth_rad[CALLS], delta[CALLS], sum[CALLS];
    static struct inverse inverse;
    int rounds = count > 1 ? atoi(words[1]) : 5;
    uint64_t random = 1;
    for (int i = 0; i < CALLS; i++) {
        truth_rad[i] = sample_between(&random, -4 * PI / 9, 4 * PI / 9);
        struct antenna_pointers pointers = antenna_pointers(&dipoles, truth_rad[i]);
        sum[i] = creal(pointers.sum);
        delta[i] = -cimag(pointers.delta);
    }
    for (int round = 0; round < rounds; round++)
        for (size_t entries = 0; entries <= MOST_ENTRIES;
             entries = entries == 0 ? 16 : 4 * entries) {
            inverse_make(&inverse, entries);
            double ns = ns_per_call(&inverse, delta, sum), total = 0, greatest = 0;
            for (int i = 0; i < CALLS; i++) {
                double error = fabs(azimuth_rad(&inverse, delta[i], sum[i]) - truth_rad[i]);
                total += error;
                greatest = fmax(greatest, error);
            }
            printf("%zu\t%.3f\t%.3g\t%.3g\n", entries, ns, total / CALLS, greatest);
        }
    return 0;
}
