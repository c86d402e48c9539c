/* Two target lists of one sensor, compared.
 *
 * The distance of two targets is in resolution cells:
 *     d^2 = (dR / cell_range)^2 + (dv / cell_range_rate)^2 + (dphi / cell_azimuth)^2,
 * with the azimuths' difference taken the short way round. Amplitudes are compared, but do not
 * decide who is paired with whom. */
#ifndef TARGET_SCORE_H
#define TARGET_SCORE_H

#include "frame/frame.h"
#include "score/score.h"

/* What counts as one cell, all positive, and from how many cells on targets are no pair. */
struct target_cell {
    double range_m, azimuth_rad, range_rate_mps;
    double cutoff;
};

/* The cell of a sensor, as the truth has it. An azimuth_rad of 0 stands for a twentieth of its
 * field of view. */
struct target_cell target_score_cell(const struct sensor_view *view, double azimuth_rad,
                                     double cutoff);

double target_score_distance(const struct target *a, const struct target *b,
                             const struct target_cell *cell);

/* Can these frames be compared? Suites may differ, for models are what is compared, but not in what
 * their sensors are called; and the truth's cells and views need a width. Refuses with DIAG_DATA.
 */
int target_score_check(const struct frame *truth, const struct frame *listed, struct diag *diag);

/* Adds one scan to the tally: its sensor's targets of both frames. The order of targets in either
 * changes no bit. */
void target_score_scan(struct score_tally *tally, const struct frame *truth,
                       const struct frame *listed, const struct target_cell *cell,
                       struct arena *arena);

#endif
