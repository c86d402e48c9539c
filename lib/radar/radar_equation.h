/* Amplitude of echoes over range; cross sections as ERCS.
 *
 * An echo's amplitude is A = A_ref(R) · A_phi(azimuth) · ERCS, all linear (MODEL 3, 4). A_ref is a
 * power law, which a reflector of calibration_ercs on boresight at calibration_range_m calibrates,
 * or a table, straight between its rows in the logarithms of range and amplitude. */
#pragma once

#include "radar/antenna.h"

struct radar_row {
    double range_m;   /* > 0, ascending */
    double amplitude; /* > 0 */
};

struct radar_equation {
    double exponent;
    double calibration_ercs;
    double calibration_range_m;
    double range_floor_m;         /* > 0; shorter ranges count as this one */
    double threshold;             /* linear amplitude */
    const struct radar_row *rows; /* of the table; NULL: the power law holds */
    size_t row_count;
};

/* A_ref at range_m >= 0. Before the first row of a table it is constant, beyond the last row it
 * goes on as between the last two. */
double radar_reference_amplitude(const struct radar_equation *equation, double range_m);

/* The greatest A_ref from one range to a farther one. */
double radar_greatest_amplitude(const struct radar_equation *equation, double from_m, double to_m);

/* The strength G of an echo before the antenna, A_ref · ERCS, and its amplitude, G · A_phi,
 * equation (2). */
double radar_strength(const struct radar_equation *equation, double range_m, double ercs);
double radar_amplitude(const struct radar_equation *equation, const struct antenna *antenna,
                       double range_m, double azimuth_rad, double ercs);

/* The range up to which A_ref · gain · ercs meets the threshold (MODEL 4.1): by the power law
 * calibration_range_m (ercs · gain / calibration_ercs)^(1/exponent), by a table the last range at
 * which its amplitude falls below the threshold; 0 if there is none, infinity if the table does not
 * fall at its end. range_floor_m does not count. gain and ercs > 0. */
double radar_detection_range_m(const struct radar_equation *equation, double gain, double ercs);

/* The equivalent radar cross section of the paper, a factor on amplitude: sqrt(sigma / 10 m^2)
 * (MODEL 3), and its inverse. */
double radar_ercs(double cross_section_m2);
double radar_cross_section_m2(double ercs);

/* The cross section in m^2 of a value in dBsm. */
double radar_cross_section_from_dbsm_m2(double dbsm);
