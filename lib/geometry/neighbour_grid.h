/* Finds places within a radius by a grid. Time to fill is proportional to the number of places,
 * time to search to the number in nine cells. */
#pragma once

#include "base/arena.h"
#include "base/vec2.h"

struct neighbour_grid {
    const struct vec2 *places;
    double radius_m, cell_m;
    uint32_t *heads; /* by cell: a place, or UINT32_MAX */
    uint32_t *next;  /* the place in the same cell after this one */
    size_t room;     /* cells that heads tells apart, a power of two */
};

/* The places must live as long as the grid; there are fewer than 2^31, all within 1e9 m. */
struct neighbour_grid neighbour_grid_of(const struct vec2 *places, size_t count, double radius_m,
                                        struct arena *arena);

/* Writes the numbers of all places within the radius of this place, itself included, in ascending
 * order; found has room for all places. Returns their count. */
size_t neighbour_grid_find(const struct neighbour_grid *grid, struct vec2 place, uint32_t *found,
                           struct arena *arena);
