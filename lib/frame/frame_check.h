/* What no table of fields can say about a frame. */
#ifndef FRAME_CHECK_H
#define FRAME_CHECK_H

#include "frame/frame.h"

/* For a frame in canonical order: ids, names, sensors, echoes and leaders stand once, the ego is
 * among the objects, echoes, cells and targets are of listed sensors, and every cell and target has
 * contributors. Refuses with DIAG_DATA. */
int frame_check(struct frame *frame, struct diag *diag);

/* All that a reader would refuse of a part: its members out of bounds, and the above. */
int frame_check_part(struct frame *frame, struct frame_part part, struct diag *diag);

#endif
