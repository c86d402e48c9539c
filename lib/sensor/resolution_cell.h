/* What a sensor measures of echoes that share a cell.
 *
 * A cell without noise has the weighted means of its echoes' ranges and range rates (MODEL 6), and
 * the sum and delta pointers of their superposition (MODEL 8). Its margins tell how near it was to
 * having other members (MODEL 11.1). */
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

/* Received echoes of positive amplitude, strongest first, and the number of each one's cell. */
struct clustered_echoes {
    const struct received_echo *echoes;
    const size_t *cell;
    size_t count;
};

/* The margins of all cells from their members and from clustering: the least sight_m of a cell's
 * members, and what follows from pairs of a leader and an echo that was left when that leader
 * opened its cell, one of them being in the cell. cell_edge is how far, in half cells, the echo was
 * from the edge of the leader's cell: from the nearer edge if it is a member, else from the edge
 * that it is farthest beyond. leader_db is by how much the leader was the stronger, if the two are
 * within two half cells of each other. */
struct margins *resolution_cell_margins(const struct sensor *sensor,
                                        const struct clustered_echoes *all, size_t cells,
                                        struct arena *arena);

/* Adds to a cell's margins those of decisions about the whole cell: the threshold on its summed
 * amplitude, and the sign of its azimuth, which only the magnitude rule decides. */
void resolution_cell_note_margins(const struct sensor *sensor, struct cell *cell);
