/* Instants of a sensor's scans, and the dwell of each.
 *
 * A sensor with a cycle has a scan at every whole multiple of cycle_s, before time 0 as well. A
 * scan belongs to the frame whose interval (time_s - interval_s, time_s] contains its instant. An
 * instant within 1e-9 of a cycle from a border of the interval is on it, so that times written as
 * i/rate and cycles written as decimals agree; rounding stays below that for some 3e6 cycles, 33
 * hours at 25 Hz. An instant at a frame's own time is exactly that time.
 *
 * A frame that lasts longer than the cycle has one scan, at its own time, as every frame has of a
 * sensor without a cycle. */
#pragma once

/* The duration of a scan's signal that resolves range rates to a cell, wavelength/(2 cell). */
double scan_timing_dwell_s(double carrier_hz, double cell_mps);

/* SCAN_TIMING_LONG_FRAME: one as well, but the frame lasts longer than the cycle. */
enum scan_timing_answer { SCAN_TIMING_NONE, SCAN_TIMING_ONE, SCAN_TIMING_LONG_FRAME };

/* Sets the instant of the scan in a frame, if the frame has one. cycle_s is 0 for a sensor without
 * a cycle. */
enum scan_timing_answer scan_timing_instant_s(double cycle_s, double time_s, double interval_s,
                                              double *instant_s);
