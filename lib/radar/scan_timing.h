/* When a sensor measures, from the frame alone: what seems to need memory has none.
 *
 * A sensor with a cycle delivers a scan at every whole multiple of cycle_s since time 0; a scan
 * belongs to the frame whose interval (time_s - interval_s, time_s] holds its instant. What it
 * shows was measured latency_s earlier. An instant within 1e-9 of a cycle counts as on it, so that
 * times written as i/rate and cycles written as decimals meet; rounding stays below that for some
 * 3e6 cycles (33 hours at 25 Hz). An instant at a frame's own time is that time exactly. */
#ifndef SCAN_TIMING_H
#define SCAN_TIMING_H

enum scan_timing_answer { SCAN_TIMING_NONE, SCAN_TIMING_ONE, SCAN_TIMING_SEVERAL };

/* Whether the frame holds an instant of the cycle, and which. cycle_s = 0 means once a frame, at
 * time_s. SCAN_TIMING_SEVERAL (the frame rate is too low for the sensor) leaves the instant unset.
 */
enum scan_timing_answer scan_timing_instant_s(double cycle_s, double time_s, double interval_s,
                                              double *instant_s);

#endif
