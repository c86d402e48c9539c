/* Compares a frame with what its objects make again.
 *
 * Values may differ by a relative 1e-9. What stages after ideal make (wheels, limbs, clutter, false
 * alarms) is not computed again: of these labels only the object is checked. */
#pragma once

#include "frame/frame.h"

/* Contributors of targets that were checked, and how many of them with their values. */
struct frame_remade {
    int64_t contributors, recomputed;
};

/* `again` has the sensors, echoes, losses and counts that ideal makes of the frame's objects, and
 * gets the frame's targets. NULL: nobody knows them, and only weights are checked. Adds to counts.
 * 0, or -1 after a message that begins with the member (DIAG_DATA). */
int frame_remade_check(const struct frame *frame, struct frame *again, struct frame_remade *counts,
                       struct diag *diag);
