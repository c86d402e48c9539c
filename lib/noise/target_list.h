/* A sensor's target list: measurements, their order, limit and rounding (MODEL 7 to 11). */
#pragma once

#include "noise/detection_quality.h"

/* Adds to the margins of a measurement those of decisions about the noisy pointers and amplitude:
 * the final threshold, if it is tested, and the sign of the azimuth. */
void target_list_note_margins(const struct sensor *sensor, const struct cell *cell,
                              struct antenna_pointers pointers, double amplitude,
                              bool final_threshold, struct margins *margins);

/* Writes count measurements of the source's sensor as targets, strongest or nearest first, ties by
 * the frame's total order, with their quality if the frame asks for it. If the source's scan
 * simulates list_limit, measurements beyond the sensor's limit are lost to the stage; so are those
 * without amplitude, which have no decibels. Without a scan (NULL) nothing is limited or rounded.
 *
 * In a frame with margins, a limit that cuts the list gives every measurement with amplitude a
 * margin: its distance, in what orders the list, to the first measurement beyond the limit if it is
 * listed, else to the last one listed.
 *
 * A sensor orders and cuts its list by unrounded values, so rounding to its steps comes last, if
 * the scan simulates quantisation; contributors keep the exact values. */
void target_list_make(struct frame *frame, const char *stage, const struct detection_source *source,
                      struct effect_measurement *measurements, size_t count);

/* Measures a cell as its sensor does: noise is added to the pointers, angle and amplitude are read
 * off them, noise is added to range and range rate, and misalignment and radome turn the azimuth.
 * False if both noisy pointers are zero, so that there is no azimuth. */
bool target_list_measure(const struct effect_scan *context, const struct cell *cell,
                         struct effect_measurement *measurement);
