/* How near a resolution cell was to having other members (MODEL 6, 11.1). */
#pragma once

#include "sensor/resolution_cell.h"

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
struct margins *cell_margins_of(const struct sensor *sensor, const struct clustered_echoes *all,
                                size_t cells, struct arena *arena);

/* Adds to a cell's margins those of decisions about the whole cell: the threshold on its summed
 * amplitude, and the sign of its azimuth, which only the magnitude rule decides. */
void cell_margins_add(const struct sensor *sensor, struct cell *cell);
