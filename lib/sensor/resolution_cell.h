/* Measurement of the echoes that share a cell, without noise.
 *
 * Range and range rate of a cell are weighted means over its echoes (MODEL 6); its sum and delta
 * pointers are those of their superposition (MODEL 8). Its margins are the distances from having
 * other members (MODEL 11.1). */
#pragma once

#include "effects/effect.h"
#include "radar/resolution.h"
#include "sensor/received_echo.h"

/* Orders received echoes by amplitude, strongest first; ties by the frame's total order
 * (frame_order_tied). For sort_items. */
int resolution_cell_compare(const void *left, const void *right);

/* Place, amplitude and phase of a received echo, for clustering. */
struct resolution_echo resolution_cell_place(const struct received_echo *echo);

/* Sets a cell's pointers, and its azimuth by the sensor's estimator. False if both pointers are
 * zero, so that there is no azimuth. */
bool resolution_cell_measure(const struct sensor *sensor, struct antenna_pointers pointers,
                             struct cell *cell);

/* For an array: sets a cell's azimuth and sum pointer, to those of a single echo, or to those of
 * the strongest beam of several echoes, whose samples at the elements it adds to the cell. The
 * delta pointer stays 0. False if the amplitude is 0. */
bool resolution_cell_see(const struct sensor *sensor, const struct received_echo *echoes,
                         size_t count, struct arena *arena, struct cell *cell);

/* Sets the cell's elevation, if the sensor measures it: the mean of its echoes' elevations by their
 * powers (MODEL 7.6). */
void resolution_cell_set_elevation(const struct sensor *sensor, const struct received_echo *echoes,
                                   size_t count, struct arena *arena, struct cell *cell);

/* Makes the cell of count echoes, strongest first, which become its members in this order.
 *
 *     amplitude          the sum of the echoes' amplitudes: the denominator of equation (5), and
 *                        the upper bound of the superposition
 *     range, range rate  the means of equation (4)
 *     pointers           equation (8) without noise, within 2 ulp of the sum of their terms while
 *                        these cancel to no less than 1e-15 of their sizes (hard case 13)
 *
 * Without superpose the pointers are those of one echo of the summed strength at the echoes' mean
 * azimuth; for a single echo they are the same bit for bit. An array uses resolution_cell_see
 * instead. False as resolution_cell_measure and resolution_cell_see. */
bool resolution_cell_of(const struct sensor *sensor, const struct received_echo *echoes,
                        size_t count, bool superpose, struct arena *arena, struct cell *cell);

/* Adds the cell of a scan to the frame, with the scan's interference and, in a frame with margins,
 * those of the whole cell. A cell without an angle or, if the effect threshold is enabled, below
 * the sensor's lowered_threshold is lost to the stage instead. */
void resolution_cell_list(struct frame *frame, const char *stage, const struct effect_scan *scan,
                          const struct selection *selection, struct cell *cell, bool has_angle);

/* Received echoes of positive amplitude, strongest first, and the number of the cell of each. */
struct clustered_echoes {
    const struct received_echo *echoes;
    const size_t *cell;
    size_t count;
    struct resolution resolution;
};

/* The margins of all cells from their members and from clustering. sight_m is the least of a cell's
 * members. Unless echoes are coherent, a leader and each echo that had no cell yet when the leader
 * opened its own are a pair, which gives two margins to the cells of both. cell_edge is the
 * distance, in half cells, of the echo from the edge of the leader's cell: from the nearer edge if
 * it is a member, else from the edge that it is farthest beyond. leader_db is the leader's lead in
 * amplitude, if the two are within two half cells of each other. */
struct margins *resolution_cell_margins(const struct sensor *sensor,
                                        const struct clustered_echoes *all, size_t cells,
                                        struct arena *arena);

/* Adds the margins of decisions about a whole cell: of the threshold on its summed amplitude,
 * unless that is 0, and of the sign of its azimuth, which only the magnitude rule decides. */
void resolution_cell_note_margins(const struct sensor *sensor, struct cell *cell);
