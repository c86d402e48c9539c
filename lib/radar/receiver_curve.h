/* Level of echoes over an angle, by a table.
 *
 * Levels are in decibels, both ways together, straight between rows and constant beyond the first
 * and the last row. They count from the level at angle 0 (MODEL 4.3). */
#pragma once

#include <stddef.h>

struct receiver_curve_row {
    double at; /* an angle in rad; ascending */
    double level_db;
};

struct receiver_curve {
    const struct receiver_curve_row *rows; /* NULL: no curve is given */
    size_t count;                          /* >= 1 with rows */
    double ahead_db;                       /* the level at angle 0 */
};

/* The level at an angle, as the table has it. A mirrored table has exactly the same level at the
 * mirrored angle. */
double receiver_curve_level_db(const struct receiver_curve *curve, double angle_rad);

/* The factor on amplitude, 10^((level(angle) - level(0))/20); exactly 1 at angle 0. */
double receiver_curve_gain(const struct receiver_curve *curve, double angle_rad);
