/* A sensor's target list: measurements, their order, limit and rounding (MODEL 9 to 11).
 */
#ifndef TARGET_LIST_H
#define TARGET_LIST_H

#include "documents/suite.h"
#include "frame/frame.h"

struct effect_scan;

/* What a sensor measures of one cell, which may become a target. */
struct measurement {
    const struct cell *cell;
    double range_m, azimuth_rad, range_rate_mps;
    double amplitude; /* linear */
    bool sign_undecided;
    uint64_t effects; /* the effects that changed one of these values */
    struct margins margins;
};

/* The measurement without noise: the cell's own values and margins; the amplitude is that of its
 * sum pointer. */
struct measurement target_list_measure(const struct cell *cell);

/* Adds to the margins of a measurement those of decisions about the noisy pointers and amplitude:
 * the final threshold, if it is tested, and the sign of the azimuth. */
void target_list_note_margins(const struct sensor *sensor, const struct cell *cell,
                              struct antenna_pointers pointers, double amplitude,
                              bool final_threshold, struct margins *margins);

/* Writes count measurements of one sensor as targets, strongest or nearest first, ties by the
 * frame's total order, at most limit of them (0: all). Measurements beyond the limit are lost to
 * the stage, and so are those without amplitude, which have no decibels.
 *
 * In a frame with margins, a limit that cuts the list gives every measurement with amplitude a
 * margin: its distance, in what orders the list, to the first measurement beyond the limit if it is
 * listed, else to the last one listed. */
void target_list_make(struct frame *frame, const char *stage, const struct sensor *sensor,
                      struct measurement *measurements, size_t count, int64_t limit);

/* Rounds the values of a listed target to the sensor's steps, if quantisation is simulated; its
 * contributors keep the exact values. A sensor orders and cuts its list by unrounded values, so
 * this comes last. */
void target_list_round(const struct effect_scan *context, struct target *target);

#endif
