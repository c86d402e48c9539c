/* Canonical order of a frame's parts, and its total orders.
 *
 * Every part that a stage reads is in canonical order, so that no result depends on the order in
 * a source. */
#pragma once

#include "frame/frame.h"

/* Brings all parts into canonical order, ascending by ids, names and paths, with a cell's leader
 * before its other members. Objects stay as they are. Targets are sorted by sensor alone. */
void frame_order(struct frame *frame);

/* The same for parts that a stage wrote. */
void frame_order_parts(struct frame *frame, struct frame_parts written);

/* The frame's objects by ascending id. They are sorted at the first call, and again if their number
 * has changed or after frame_order_parts with PART_OBJECTS. */
struct object *const *frame_order_objects(struct frame *frame);

/* The total order of echoes of equal amplitude: by range, range rate, azimuth, then as
 * frame_order_echo_ids. Negative, zero or positive. */
int frame_order_tied(const struct contributor *a, const struct contributor *b);

/* The canonical order of one sensor's echoes, for struct echo_id and structs that begin with one:
 * by object, reflector, path, mirror, number. */
int frame_order_echo_ids(const void *left, const void *right);

/* The canonical orders of names (const char *), or structs that begin with a name, of echoes, of
 * cells and of lost groups, for sort_items. */
int frame_order_names(const void *left, const void *right);
int frame_order_echoes(const void *left, const void *right);
int frame_order_cells(const void *left, const void *right);
int frame_order_lost_groups(const void *left, const void *right);
int frame_order_sightings(const void *left, const void *right);
