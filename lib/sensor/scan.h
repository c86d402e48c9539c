/* One scan before noise: received echoes and their cells.
 *
 * All memory of a scan comes from the frame's arena. */
#pragma once

#include "effects/effect.h"
#include "sensor/resolution_cell.h"

struct scan {
    struct effect_scan context;
    struct echo_span added;              /* echoes that effects add: of wheels, limbs, clutter */
    struct clustered_echoes received;    /* the echoes of positive amplitude */
    size_t cells;                        /* number of cells, in the order of their leaders */
    const struct received_echo *by_cell; /* the same by cell; coherent ones as at their leader */
    const size_t *first;                 /* first echo of each cell in by_cell, then the total */
    const struct received_echo *silent;  /* echoes without amplitude, which are in no cell */
    size_t silent_count;
};

/* Receives the echoes of the context and the echoes that effects add. Makes no cells. */
struct scan scan_receive(const struct effect_scan *context);

/* Receives the echoes and sorts them into cells. auto leaves out merging if no two echoes are
 * close. */
struct scan scan_make(const struct effect_scan *context, const struct selection *selection);

/* The members of cell `number`, the leader first; sets count. */
const struct received_echo *scan_members(const struct scan *scan, size_t number, size_t *count);

/* Counts the added echoes in the frame, by their paths, and writes the loss of every silent echo,
 * with its margins. */
void scan_account(const struct scan *scan, struct frame *frame, const char *stage);
