/* Dipole pairs with their phase from the centre and from one element, and a table. */
#pragma once

#include "radar/antenna.h"

static const struct antenna CENTRE = {.pattern = ANTENNA_DIPOLE_PAIR, .phase = PHASE_CENTRE};
static const struct antenna ELEMENT = {.pattern = ANTENNA_DIPOLE_PAIR, .phase = PHASE_ELEMENT};

static const struct antenna_row SKEWED_ROWS[] = {
    {-1.2, 0, -0.3}, {-0.5, 0.4, -0.5}, {0.1, 1, 0.1}, {0.6, 0.7, 0.6}, {1.3, 0.05, 0.4}};
static const struct antenna SKEWED = {.pattern = ANTENNA_TABLE,
                                      .phase = PHASE_CENTRE,
                                      .rows = SKEWED_ROWS,
                                      .row_count = sizeof SKEWED_ROWS / sizeof *SKEWED_ROWS};

/* The i-th of 100,000 azimuths in (0, 90 deg), dense near both ends, down to so many decades. */
static inline double antennas_dense_azimuth(int i, double decades)
{
    if (i < 40000)
        return 1.5 * (i + 1) / 40001;
    if (i < 70000)
        return pow(10, -decades * (i - 40000) / 30000);
    return PI / 2 - pow(10, -12.0 * (i - 70000) / 30000);
}
