/* Check that every echo is still there or lost.
 *
 * Every pair of a sensor that measured and a reflector must have exactly one direct entry, in a
 * target's label or in lost; every echo of another path that was made must have one too. Before
 * there are targets, cells or echoes stand for them. Frames that carry an account (sections.h) are
 * checked after the stage that writes targets, and by sinks and tools that read them from another
 * process. The check knows how many entries each path is due, not which: a missing entry together
 * with an invented one would pass. */
#pragma once

#include "frame/frame.h"

/* For frames that keep account and have targets, cells or echoes. Fails with DIAG_DATA, and names
 * the first echo that has two entries or the first sensor with a wrong number of entries: an
 * account that does not add up was in most cases wrong when it was read. */
int frame_account_check(const struct frame *frame, struct diag *diag);
