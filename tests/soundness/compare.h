/* Compares two frames that ought to be equal: one scene seen with every effect and with those that
 * a planner chose. */
#pragma once

#include "frame/frame.h"

/* Compares targets, and with an account lost too, bit by bit. Returns 0, or -1 with the first
 * difference in the diag, such as "targets[3].range_m". */
int compare_bits(const struct frame *all, const struct frame *chosen, bool account,
                 struct diag *diag);
