/* Checks a frame by itself: its parts, and its account.
 *
 * The tables of fields check each member; this module checks members against each other. */
#pragma once

#include "frame/frame.h"

/* Checks parts of a frame, ~0U for all that are read, in canonical order (frame_order.h). Ids of
 * objects, names of strips beside the road, names of sensors, names and objects of a reflector set,
 * echoes and leaders of cells must be unique; reasons of losses are words of a to z and _; the ego
 * must be among the objects; echoes, cells and targets must be of listed sensors; cells must have
 * members and targets contributors. Fails with DIAG_DATA. */
int frame_check(struct frame *frame, unsigned parts, struct diag *diag);

/* Checks only parts that a stage wrote: members against their bounds, then as frame_check. A header
 * with lists is always checked, because their items may change in place. */
int frame_check_parts(struct frame *frame, struct frame_parts written, struct diag *diag);

/* Checks the members of an object against their bounds, and that its class is no path. Fails with
 * DIAG_DATA. */
int frame_check_object(const struct object *object, struct diag *diag);

/* For a frame that fails frame_check_parts after a stage because of extreme input: names the object
 * of the first entry with a value out of bounds (DIAG_DATA); 0 if there is none. */
int frame_check_extremes(const struct frame *frame, struct diag *diag);

/* Checks the account of a frame with targets, cells or echoes: every echo is in a target or lost.
 * Every pair of a sensor that measured and a reflector must have exactly one direct entry, in a
 * target's label or in lost, and every other echo that was made must have one too. In a frame
 * without targets, its cells or echoes take their place. The check compares numbers of entries for
 * each sensor and path: a missing entry and an invented one cancel.
 *
 * Fails with DIAG_DATA, and names the first echo that has two entries or the first sensor with a
 * wrong number of entries. The runner checks frames that carry an account (sections.h) after the
 * stage that writes targets; sinks and tools check frames that they read. */
int frame_check_account(const struct frame *frame, struct diag *diag);
