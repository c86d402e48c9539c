/* The one order of everything in a frame, so that no result depends on how things were listed. */
#ifndef FRAME_ORDER_H
#define FRAME_ORDER_H

#include "frame/frame.h"

/* Brings the sections into canonical order: ids, names and paths ascending, a cell's leader first.
 * Objects stay as they are; targets, in the order of their sensor's list, are grouped by sensor. */
void frame_order(struct frame *frame);
void frame_order_part(struct frame *frame, struct frame_part part);

/* The objects by id, ascending; as many as the frame has. They are sorted at the first call, and
 * after a change of the list by frame_order_part of its section. */
struct object *const *frame_order_objects(struct frame *frame);

/* The total order in which echoes compete wherever amplitudes tie: range, range rate, azimuth, then
 * object, reflector, path. Negative, zero or positive. */
int frame_order_tied(const struct contributor *a, const struct contributor *b);

/* The canonical order of what echoes of one sensor are of: object, reflector, path, mirror, number.
 */
int frame_order_echo_ids(struct echo_id a, struct echo_id b);

/* The canonical order of names (const char *), echoes and cells, for sort_items. */
int frame_order_names(const void *left, const void *right);
int frame_order_echoes(const void *left, const void *right);
int frame_order_cells(const void *left, const void *right);

#endif
