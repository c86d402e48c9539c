/* What a sensor reads off its cells, and the list it makes of that (MODEL 9 to 11). */
#ifndef TARGET_LIST_H
#define TARGET_LIST_H

#include "documents/suite.h"
#include "frame/frame.h"

struct effect_scan;

/* One entry of the list before it is one. */
struct measurement {
    const struct cell *cell;
    double range_m, azimuth_rad, range_rate_mps;
    double amplitude; /* linear */
    bool sign_undecided;
    uint64_t effects; /* that changed one of these values */
    struct margins margins;
};

/* The cell's own noise-free values and margins; the amplitude is that of its sum pointer. */
struct measurement target_list_measure(const struct cell *cell);

/* Adds to the margins of a measurement what was decided about the noisy cell: the final threshold,
 * if it is tested, and the sign of its azimuth. */
void target_list_note_margins(const struct sensor *sensor, const struct cell *cell,
                              struct antenna_pointers pointers, double amplitude,
                              bool final_threshold, struct margins *margins);

/* Writes count measurements of one sensor as targets: strongest or nearest first, ties by the
 * frame's total order, at most limit of them (0: all). The rest is lost for the stage. A
 * measurement without amplitude is lost too: it has no decibels. In a frame with margins, those of
 * the measurements get that of the limit, if it cuts the list: from what is listed to the first
 * that is not, and from that to the last listed. */
void target_list_make(struct frame *frame, const char *stage, const struct sensor *sensor,
                      struct measurement *measurements, size_t count, int64_t limit);

/* Rounds the values of a listed target to the sensor's steps, if quantisation is simulated; its
 * contributors keep the exact ones. The last of all: a sensor orders and cuts its list by the
 * values that it has itself. */
void target_list_round(const struct effect_scan *context, struct target *target);

#endif
