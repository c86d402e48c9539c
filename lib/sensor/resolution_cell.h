/* What a sensor measures of echoes that share a cell.
 *
 * A cell without noise has the weighted means of its echoes' ranges and range rates (MODEL 6), and
 * the sum and delta pointers of their superposition (MODEL 8). */
#pragma once

#include "radar/resolution.h"
#include "sensor/received_echo.h"

/* Orders received echoes by amplitude, strongest first; ties by the frame's total order
 * (frame_order_tied). For sort_items. */
int resolution_cell_compare(const void *left, const void *right);

/* Where a received echo lies, for clustering. */
struct resolution_echo resolution_cell_place(const struct received_echo *echo);

/* Makes the cell of count echoes, strongest first, which become its members in this order; the
 * members' memory comes from the arena.
 *
 *     amplitude          the sum of the echoes' amplitudes, which is the denominator of equation
 *                        (5) and the upper bound of what the cell can return
 *     range, range rate  the means of equation (4)
 *     pointers           equation (8) without noise, within 2 ulp of the sum of their terms while
 *                        these cancel to no less than 1e-15 of their sizes (hard case 13)
 *     azimuth            read off the pointers by the sensor's estimator
 *
 * Without superpose the pointers are those of one echo of the summed strength at the echoes' mean
 * azimuth; for a single echo they are the same bit for bit. False if both pointers are zero, so
 * that there is no azimuth. */
bool resolution_cell_of(const struct sensor *sensor, const struct received_echo *echoes,
                        size_t count, bool superpose, struct arena *arena, struct cell *cell);

/* Adds the cell to the frame, or loses its echoes for the stage: below the detection threshold, if
 * the effect threshold is enabled, or without an angle. */
void resolution_cell_list(struct frame *frame, const char *stage, const struct sensor *sensor,
                          const struct selection *selection, const struct cell *cell,
                          bool has_angle);
