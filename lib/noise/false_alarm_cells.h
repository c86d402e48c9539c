/* False alarms: targets of noise alone, above the threshold.
 *
 * Their number in a scan has a Poisson distribution (MODEL 14.9). Each is uniform in range, azimuth
 * and range rate, in elevation if that is measured, and as strong as noise that has passed the
 * threshold. A false alarm is a cell with one contributor: number n, from 1, of the reflector
 * "cell" of the object "noise", which is no object of the frame. */
#pragma once

#include "frame/frame.h"

struct effect_scan;
struct sensor;

/* The contributor of false alarm `number` of a scan, from 1, without values. Number 0 is the
 * address of all draws of the scan. */
struct contributor false_alarm_cells_contributor(int64_t number);

/* Draws the elevation of a false alarm, evenly over the view of a sensor that measures it. */
void false_alarm_cells_draw_elevation(const struct frame *frame, const struct sensor *sensor,
                                      struct contributor *alarm);

/* The cell of a false alarm with this contributor. */
struct cell false_alarm_cells_cell(const struct sensor *sensor,
                                   const struct contributor *contributor, double amplitude,
                                   struct arena *arena);

/* The amplitude of noise that has passed the threshold, from a uniform draw in (0, 1). Its power is
 * threshold^2 + noise_sigma^2 Exp(1), as an exponential distribution has no memory. noise_sigma is
 * the RMS of the complex noise of the search for echoes; if it is 0, the amplitude is the
 * threshold. */
double false_alarm_cells_amplitude(double threshold, double noise_sigma, double uniform);

/* Makes the false alarms of a scan and counts them in the frame, which is that of the context. None
 * if the effect is not simulated or the sensor did not measure in this frame. */
struct cell_span false_alarm_cells_of(struct frame *frame, const struct effect_scan *context);
