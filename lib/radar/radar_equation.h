/* How strong an echo is (MODEL 3 and 4): A = A_ref(R) · A_phi(azimuth) · ERCS, all linear.
 *
 * A_ref follows a power law through the calibration point (a reflector of calibration_ercs is just
 * at the threshold on boresight at calibration_range_m; equation 3 with exponent 2 is the radar
 * equation's 40 dB per decade), or a table over range, straight between its rows in the logarithm
 * of both. Below range_floor_m the range counts as range_floor_m. */
#ifndef RADAR_EQUATION_H
#define RADAR_EQUATION_H

#include <stddef.h>

enum radar_law { RADAR_POWER_LAW, RADAR_TABLE };

struct radar_row {
    double range_m;   /* > 0, ascending */
    double amplitude; /* > 0 */
};

struct radar_equation {
    enum radar_law law;
    double exponent;
    double calibration_ercs;
    double calibration_range_m;
    double range_floor_m; /* > 0 */
    double threshold;     /* linear amplitude */
    const struct radar_row *rows;
    size_t row_count;
};

/* A_ref(range), range >= 0. A table is held constant at its first row below it and follows its
 * last two rows beyond it. */
double radar_reference_amplitude(const struct radar_equation *law, double range_m);

/* Where A_ref(R) · gain · ercs meets the threshold (MODEL 4.1), power law only, for figures and
 * tests: calibration_range_m (ercs · gain / calibration_ercs)^(1/exponent). */
double radar_detection_range_m(const struct radar_equation *law, double gain, double ercs);

/* The paper's equivalent radar cross section, an amplitude factor: sqrt(sigma / 10 m^2). For those
 * who write vehicle documents. */
double radar_ercs(double cross_section_m2);
double radar_cross_section_m2(double ercs);

/* Of decibels over 1 m^2, a power. */
double radar_cross_section_from_dbsm_m2(double dbsm);

#endif
