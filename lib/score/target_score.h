/* Score of one sensor's target list against the true one.
 *
 * The distance d of two targets is in resolution cells (MODEL 11.2), with the difference in azimuth
 * taken the short way round. Amplitudes are compared, but do not decide which targets are paired.
 */
#pragma once

#include "frame/frame.h"
#include "score/score.h"

/* The size of a cell, all positive. */
struct target_cell {
    double range_m, azimuth_rad, range_rate_mps;
};

enum { TARGET_SCORE_CUTOFF = 2 }; /* targets so many cells apart are no pair */

/* The cell of a sensor, from the view in the truth. An azimuth_rad of 0 stands for the view's
 * azimuth_cell_rad, or where that is absent for a twentieth of its field of view. */
struct target_cell target_score_cell(const struct sensor_view *view, double azimuth_rad);

/* True if its cells and its field of view have a width, so that there are distances in cells. */
bool target_score_has_cells(const struct sensor_view *view);

double target_score_distance(const struct target *a, const struct target *b,
                             const struct target_cell *cell);

/* Refuses frames that cannot be compared (DIAG_DATA). Suites may differ, but not in the names of
 * their sensors; and cells and fields of view of the truth must be wider than 0. */
int target_score_check(const struct frame *truth, const struct frame *listed, struct diag *diag);

/* True if the sensor, which both frames have, measured in both: a scan that one side did not make
 * has no targets to miss, and those of the other side are not false. */
bool target_score_is_compared(const char *sensor, const struct frame *truth,
                              const struct frame *listed);

/* A true target and the listed one that it is paired with. truth is NULL for a false target, listed
 * for a missed one. */
struct target_pair {
    const struct target *truth, *listed;
};

struct target_pairs {
    LIST_OF(struct target_pair) list;
};

/* Pairs the targets of a sensor in both frames as the score does: all true targets in ascending
 * order, and then all false ones. */
struct target_pairs target_score_pairs(const char *sensor, const struct frame *truth,
                                       const struct frame *listed, const struct target_cell *cell,
                                       struct arena *arena);

/* Adds one scan to the tally: the targets of the tally's sensor in both frames; a scan that only
 * one of them has is counted alone. The order of targets changes no bit. */
void target_score_scan(struct score_tally *tally, const struct frame *truth,
                       const struct frame *listed, const struct target_cell *cell,
                       struct arena *arena);
