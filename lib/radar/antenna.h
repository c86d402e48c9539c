/* Antenna: sum and delta pointers over azimuth, errors of boresight.
 *
 * The dipole pair is equation (6) of the paper (MODEL 7.1): two half-wavelength dipoles half a
 * wavelength apart, with phases counted from the first dipole (PHASE_ELEMENT, the equation as
 * printed) or from the array's centre (PHASE_CENTRE). A cell with one echo has the same angle
 * either way, a cell with several echoes does not (MODEL 8.1).
 *
 * A measured pattern is a table of sum and delta amplitudes over azimuth. Both are linear between
 * rows and zero outside the table; delta is signed, positive to the left. Between two rows
 * delta/sum, a ratio of two straight lines, is monotone and has a closed inverse, so that a single
 * noise-free echo is read at its own azimuth.
 *
 * An array (radar/array.h) has the sum amplitude 1 and no delta channel.
 *
 * A receiver curve over azimuth replaces the sum amplitude of any pattern. The delta amplitude
 * keeps its ratio to the sum, by which angles are read (MODEL 4.3). */
#pragma once

#include <complex.h>
#include <stdbool.h>

#include "radar/receiver_curve.h"

enum antenna_pattern { ANTENNA_DIPOLE_PAIR, ANTENNA_TABLE, ANTENNA_ARRAY };
enum antenna_phase { PHASE_CENTRE, PHASE_ELEMENT };

/* A row of a pattern table. Azimuth and delta/sum ascend strictly from row to row. */
struct antenna_row {
    double azimuth_rad; /* [-pi/2, pi/2] */
    double sum;         /* amplitude, >= 0 */
    double delta;       /* signed amplitude */
};

struct antenna {
    enum antenna_pattern pattern;
    enum antenna_phase phase;       /* a table has the phase of the dipole pair */
    const struct antenna_row *rows; /* of ANTENNA_TABLE */
    size_t row_count;
    struct receiver_curve curve; /* over azimuth */
};

struct antenna_pointers {
    double _Complex sum, delta;
};

/* The pointers of one echo of amplitude 1 at an azimuth in [-pi/2, pi/2]; both are zero outside a
 * table of sum and delta, and under a curve the sum stays zero where its pattern has a zero. Under
 * PHASE_CENTRE the mirrored azimuth has exactly the same sum and the negated delta. The dipole
 * pair's magnitudes are within 8 ulp of the formula and its components within 12, up to 1e-12 rad
 * from +-pi/2 (hard cases 1 to 5). */
struct antenna_pointers antenna_pointers(const struct antenna *antenna, double azimuth_rad);

/* |H_sum|: the antenna pattern A_phi of equation (2). */
double antenna_gain(const struct antenna *antenna, double azimuth_rad);

/* The width of the main beam where A_phi is down to 1/sqrt 2, 3 dB both ways together: twice the
 * least such azimuth to the left, within 5e-5 rad, but for dips narrower than 4e-4 rad; PI if there
 * is none. */
double antenna_beam_rad(const struct antenna *antenna);

/* The azimuth from which on, to either side, echoes are outside a field of view of that full width:
 * 1e-9 rad before its border, so that the foot on a wall parallel to boresight, at 90 degrees but
 * for rounding, is outside (MODEL 2.5). */
double antenna_border_rad(double field_of_view_rad);

/* The azimuth at which the antenna has this ratio of delta to sum: equation (7) inverted (MODEL
 * 7.2). sum >= 0, delta is signed, not both are zero. The result is in [-pi/2, pi/2], or within the
 * ends of a table; for the dipole pair it is within 4 ulp (hard case 7). */
double antenna_azimuth_rad(const struct antenna *antenna, double delta, double sum);

/* The reason why a table cannot be inverted, as a sentence, or NULL if it can. A table needs at
 * least two rows, sums >= 0, in no row both amplitudes zero, and azimuth and delta/sum that ascend
 * strictly. *row becomes the first row at fault, counted from 0, or count if rows are missing. */
const char *antenna_table_fault(const struct antenna_row *rows, size_t count, size_t *row);

/* Azimuth error of a misaligned sensor behind a bumper (MODEL 14.8). The boresight is to the right
 * of its documented direction by the yaw error. The bumper, a radome, bends the beam by the bias,
 * with periods of 20 to 40 degrees in practice. */
struct boresight_error {
    double yaw_error_rad;
    double bias_rad;
    double bias_period_rad; /* > 0 unless bias_rad is 0 */
    double bias_phase_rad;
};

/* The reported azimuth, in (-pi, pi]. Without yaw error and bias it is azimuth_rad itself, if that
 * is in this interval. */
double antenna_reported_rad(const struct boresight_error *error, double azimuth_rad);
