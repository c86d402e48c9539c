/* One scan of one sensor before noise: the rays that it received, and which of them share a cell.
 */
#ifndef SCAN_H
#define SCAN_H

#include "cell_margins.h"
#include "scatterers.h"

struct scan {
    struct reception reception;
    struct echo_span scatterers; /* beyond the frame's echoes */
    struct clustered_rays resolved;
    size_t cells;              /* numbered in the order of their leaders */
    const struct ray *by_cell; /* the same rays, those of a cell together */
    const size_t *first;       /* of each cell among them, and behind the last */
    const struct ray *silent;  /* without amplitude: they are in no cell */
    size_t silent_count;
};

/* Receives the echoes, and resolves none of them. Memory comes from the frame's arena. */
struct scan scan_receive(const struct reception *reception);

/* Receives the echoes and resolves them, with all effects of the reception but those of without;
 * merging may be left out where no two rays are close. Memory comes from the frame's arena. */
struct scan scan_make(const struct reception *reception, const struct selection *selection,
                      uint64_t without);

/* The rays of one cell, the leader first, count of them. */
const struct ray *scan_members(const struct scan *scan, size_t number, size_t *count);

#endif
