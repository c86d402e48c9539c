/* Cells that are detected without noise.
 *
 * A sensor whose first threshold is lowered passes cells that only noise can lift over the final
 * threshold (MODEL 8.4). Where noise is not tested, these are lost. */
#pragma once

#include "documents/suite.h"
#include "frame/frame.h"

/* The cells of the sensor, in their order, without those below its threshold, which are lost to the
 * stage. */
struct cell_span steady_cells_of(struct frame *frame, const char *stage,
                                 const struct sensor *sensor);
