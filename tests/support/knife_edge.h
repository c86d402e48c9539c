/* Losses behind an edge: the library's, and those of Fresnel's integrals. */
#pragma once

#include "base/units.h"
#include "geometry/obstruction.h"

/* J in dB, one way (MODEL 14.4). */
static inline double knife_edge_db(double parameter)
{
    return -units_amplitude_db(obstruction_edge_amplitude_factor(parameter)) / 2;
}

/* Fresnel's integrals behind an edge: -20 lg(|1 - C - S + j (C - S)|/2), by Simpson's rule. */
static inline double knife_edge_exact_db(double parameter)
{
    enum { STEPS = 20000 };
    double c = 0, s = 0;
    for (int k = 0; k <= STEPS; k++) {
        double t = parameter * k / STEPS;
        double weight = (k == 0 || k == STEPS ? 1 : k % 2 ? 4 : 2) * parameter / STEPS / 3;
        c += weight * cos(PI / 2 * t * t);
        s += weight * sin(PI / 2 * t * t);
    }
    return -20 * log10(hypot(1 - c - s, c - s) / 2);
}
