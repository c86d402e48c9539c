/* A recording in memory, in the order of time. */
#pragma once

#include "recorded/recorded_row.h"

/* Reads all rows of the reader and closes it; what it gives comes from memory: 64 bytes a row, and
 * some hundred for each step, track and size of a body. A yaw rate is kept to 24 bits, a speed not
 * at all. The format of the new reader is the old one's, but by time and with marked steps; its
 * format is NULL after a message. */
struct recorded_reader recorded_store_read(struct recorded_reader reader, struct arena *arena,
                                           struct diag *diag);
