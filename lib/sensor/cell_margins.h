/* How close the decisions that made a resolution cell were (MODEL 6, 11.1). */
#ifndef CELL_MARGINS_H
#define CELL_MARGINS_H

#include "sensor/resolution_cell.h"

/* Rays as the sensor clustered them, strongest first, each with the number of its cell. */
struct clustered_echoes {
    const struct received_echo *received_echoes;
    const size_t *cell;
    size_t count;
};

/* Sight of the members, and what made them this cell: for every cell's leader L and every echo m
 * that was left when L opened its cell, where one of them is in cell `number`, whether m shared L's
 * cell (cell_edge: the nearer edge, or the edge that it is farthest beyond), and if they are within
 * two half cells of each other, that L came first (leader_db). */
struct margins cell_margins_of(const struct sensor *sensor, const struct clustered_echoes *all,
                               size_t number);

/* Adds what was decided about the cell as a whole: the threshold on its summed amplitude, and the
 * sign of its azimuth, which only the magnitude rule decides. */
void cell_margins_add(const struct sensor *sensor, struct cell *cell);

#endif
