/* Sum and delta pointers of a monopulse antenna, and the angle they stand for (MODEL 7).
 *
 * The dipole pair is the paper's equation (6): two half-wavelength dipoles half a wavelength
 * apart. With u = (pi/2) sin(azimuth) and f = si(u) cos(azimuth),
 *     H_sum = f cos u · e,   H_delta = -j f sin u · e,
 * where e = e^{ju} if the phase is counted from the first dipole (PHASE_ELEMENT, the equation as
 * printed) and e = 1 if from the array's centre (PHASE_CENTRE, which the paper's Fig. 10 needs).
 * One target cannot tell the two apart; several in one cell can.
 *
 * A measured pattern is a table of sum and delta amplitude over azimuth, linear between its rows
 * and zero outside; delta is signed (positive to the left where the antenna is unambiguous).
 * Inside an interval the ratio of two straight lines is monotone and has a closed inverse, so a
 * single noise-free target comes back at its own azimuth. */
#ifndef ANTENNA_H
#define ANTENNA_H

#include <complex.h>
#include <stdbool.h>
#include <stddef.h>

enum antenna_pattern { ANTENNA_DIPOLE_PAIR, ANTENNA_TABLE };
enum antenna_phase { PHASE_CENTRE, PHASE_ELEMENT };

/* Rows ascend in azimuth; the ratio delta/sum must ascend strictly (antenna_table_fault). */
struct antenna_row {
    double azimuth_rad; /* [-pi/2, pi/2] */
    double sum;         /* amplitude, >= 0 */
    double delta;       /* signed amplitude */
};

struct antenna {
    enum antenna_pattern pattern;
    enum antenna_phase phase; /* a table has no phase of its own: u is the dipole pair's */
    const struct antenna_row *rows;
    size_t row_count;
};

struct antenna_pointers {
    double _Complex sum, delta;
};

/* Both pointers for one echo of unit amplitude at azimuth in [-pi/2, pi/2]. Exactly symmetric:
 * the mirrored azimuth gives the same sum and the negated delta under PHASE_CENTRE. Magnitudes
 * within 8 ulp of the formula, components within 12, up to 1e-12 rad from the side (NUMERICS 1 to
 * 5). Zero outside a table. */
struct antenna_pointers antenna_pointers(const struct antenna *antenna, double azimuth_rad);

/* |H_sum|: the antenna pattern A_phi of equation (2). */
double antenna_gain(const struct antenna *antenna, double azimuth_rad);

/* The azimuth whose signed ratio delta : sum is the given pair (equation 7 inverted; sum >= 0,
 * delta signed, not both zero). In [-pi/2, pi/2]; a table clamps to its ends. Within 4 ulp for the
 * dipole pair up to the side (NUMERICS 7). */
double antenna_azimuth_rad(const struct antenna *antenna, double delta, double sum);

/* Why the rows cannot be inverted, as a sentence, or NULL: there must be two rows or more, azimuth
 * ascend, sum be >= 0, not both zero, delta/sum ascend strictly. *row becomes the row at fault,
 * counted from 0 (count where rows are missing). */
const char *antenna_table_fault(const struct antenna_row *rows, size_t count, size_t *row);

#endif
