/* Consistency of a frame's sections, and its account.
 *
 * Tables hold single members to their bounds; this holds sections to each other. */
#pragma once

#include "frame/frame.h"

/* Checks a frame in canonical order (frame_order.h). Ids of objects, names of sensors, names and
 * objects of a reflector set, echoes and leaders of cells must be unique; reasons of losses are
 * words of a to z and _; the ego must be among the objects; echoes, cells and targets must be of
 * listed sensors; cells must have members and targets contributors. Fails with DIAG_DATA. */
int frame_check(struct frame *frame, struct diag *diag);

/* Checks a part of a frame as a reader of its line would: its members against their bounds, and
 * then as frame_check. */
int frame_check_part(struct frame *frame, struct frame_part part, struct diag *diag);

/* Checks the members of an object against their bounds, and that its class is no path. Fails with
 * DIAG_DATA. */
int frame_check_object(const struct object *object, struct diag *diag);

/* For a written frame that fails frame_check_part because extreme values were read: names the
 * object of the first entry whose own values are out of bounds (DIAG_DATA). 0 if there is none. */
int frame_check_extremes(const struct frame *frame, struct diag *diag);

/* For frames that keep account and have targets, cells or echoes: checks that every echo is still
 * there or lost. Every pair of a sensor that measured and a reflector must have exactly one direct
 * entry, in a target's label or in lost; every echo of another path that was made must have one
 * too. Before there are targets, cells or echoes stand for them. The check knows how many entries
 * each path is due, not which: a missing entry together with an invented one would pass.
 *
 * Fails with DIAG_DATA, and names the first echo that has two entries or the first sensor with a
 * wrong number of entries: an account that does not add up was in most cases wrong when it was
 * read. Frames that carry an account (sections.h) are checked after the stage that writes targets,
 * and by sinks and tools that read them from another process. */
int frame_check_account(const struct frame *frame, struct diag *diag);
