/* A sensor's target list: measurements, their order, limit and rounding (MODEL 7 to 11). */
#pragma once

#include "noise/detection_quality.h"

/* Adds the margins of decisions about noisy pointers and amplitude: of the final threshold, if it
 * is tested, and of the sign of the azimuth. */
void target_list_note_margins(const struct sensor *sensor, const struct cell *cell,
                              struct antenna_pointers pointers, double amplitude,
                              bool final_threshold, struct margins *margins);

/* Writes count measurements of the source's sensor as targets, strongest or nearest first, ties by
 * the frame's total order, with quality if the frame carries it. Measurements without amplitude,
 * which have no decibels, and measurements beyond the sensor's limit, if the source's scan
 * simulates list_limit, are lost to the stage. Without a scan (NULL) nothing is limited or rounded.
 *
 * In a frame with margins, a limit that cuts the list gives a margin to every measurement with
 * amplitude: the difference, in the value that orders the list, to the first measurement beyond the
 * limit, or for a measurement beyond it to the last one listed.
 *
 * A sensor orders and cuts its list by unrounded values. So rounding comes last, if the scan
 * simulates quantisation; contributors keep the exact values. */
void target_list_make(struct frame *frame, const char *stage, const struct detection_source *source,
                      struct effect_measurement *measurements, size_t count);

/* Measures a cell: adds noise to the pointers, computes angle and amplitude from them, adds noise
 * to range and range rate, and turns the azimuth by misalignment and radome. False if both noisy
 * pointers are zero, so that there is no azimuth. */
bool target_list_measure(const struct effect_scan *context, const struct cell *cell,
                         struct effect_measurement *measurement);
