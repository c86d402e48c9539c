/* One scan of one sensor before noise: the received echoes that it received, and which of them
 * share a cell.
 */
#ifndef SCAN_H
#define SCAN_H

#include "effects/effect.h"
#include "sensor/cell_margins.h"

struct scan {
    struct effect_scan context; /* the effects that it is received with */
    struct echo_span added;     /* to the frame's echoes: of wheels, limbs, clutter */
    struct clustered_echoes resolved;
    size_t cells;                        /* numbered in the order of their leaders */
    const struct received_echo *by_cell; /* the same received echoes, those of a cell together */
    const size_t *first;                 /* of each cell among them, and behind the last */
    const struct received_echo *silent;  /* without amplitude: they are in no cell */
    size_t silent_count;
};

/* Receives the echoes, and resolves none of them. Memory comes from the frame's arena. */
struct scan scan_receive(const struct effect_scan *context);

/* Receives the echoes and resolves them; merging may be left out where no two received echoes are
 * close. Memory comes from the frame's arena. */
struct scan scan_make(const struct effect_scan *context, const struct selection *selection);

/* The received echoes of one cell, the leader first, count of them. */
const struct received_echo *scan_members(const struct scan *scan, size_t number, size_t *count);

/* Counts the added echoes in the frame. */
void scan_count_added(const struct scan *scan, struct frame *frame);

/* Writes into the frame that the stage lost the silent echoes, each with its margins. */
void scan_lose_silent(const struct scan *scan, struct frame *frame, const char *stage);

#endif
